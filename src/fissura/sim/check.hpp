#pragma once
#include <string>

#include "fissura/model/case.hpp"

namespace fissura::sim {

/// Builds the model and forecasts what running it takes: tets, joints, time step, steps, hours, memory, disk;
/// with all notes and warnings. Throws core::InputError with everything that is wrong.
/// `frames_folder`: where to leave the case at t = 0 as frames, for a picture of the body and its bars;
/// empty: nowhere.
std::string check_case(model::Case const& c, std::string const& frames_folder = {});

} // namespace fissura::sim
