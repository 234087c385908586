#pragma once
// Bodies that are in motion at t = 0.
#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::step {

/// Sets the initial velocities of the nodes. Nodes that move as one share their momentum; what a support or
/// motion holds from the start stays at rest.
void set_in_motion(model::Model const& m, state::State& s);

/// Kinetic energy of nodes and impactors by the velocities as they stand [J].
double kinetic_energy(model::Model const& m, state::State const& s);

} // namespace fissura::step
