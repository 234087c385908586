#pragma once
// Loads that change while a run goes on: what a script between two steps may do.
#include <string>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

/// Replaces the curve of a motion, a force, a traction or gravity ("gravity") from the present time on. `key`
/// is that of the deck: displacement, velocity, force, traction or acceleration. Time 0 of the new curve is
/// now. A ramp sets out from the present value, so nothing jumps; a constant and a table act as they are
/// written. A displacement is that of the points from where they were at t = 0. Throws
/// core::Error(Failure::input) for a name that is no load, a key that is not its own, a load that follows a
/// path, and a load whose stage has not begun.
void change_load(model::Model& m, state::State const& s, std::string const& name, std::string const& key,
                 model::Curve curve);

} // namespace fissura::sim
