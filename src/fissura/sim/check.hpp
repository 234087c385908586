#pragma once
#include <string>

#include "fissura/model/case.hpp"

namespace fissura::sim {

/// Builds the model and forecasts what running it takes: tets, joints, time step, steps, hours, memory, disk;
/// with all notes and warnings. Throws core::InputError with everything that is wrong.
std::string check_case(model::Case const& c);

} // namespace fissura::sim
