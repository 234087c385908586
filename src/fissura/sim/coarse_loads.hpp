#pragma once
// Loads that change faster than the time step can follow.
#include <string>
#include <vector>

#include "fissura/model/model.hpp"

namespace fissura::sim {

/// "motion `pull`: its ramp of 1 ms has 2 time steps of 0.5 ms", one for each such load. A ramp of a few
/// steps is a jump, and the energy balance, which reads forces and velocities step by step, cannot follow it.
std::vector<std::string> coarse_loads(model::Model const& m);

} // namespace fissura::sim
