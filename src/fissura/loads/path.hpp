#pragma once
// A motion to and fro whose turning points are readings of gauges: "pull to 0.2 % mean strain, back to zero
// force, ...".
#include <vector>

#include "fissura/model/loads.hpp"
#include "fissura/state/state.hpp"

namespace fissura::loads {

/// Velocity of the path at time t [m/s]: steady between turns; a turn passes from the velocity and the
/// acceleration it found to the new velocity without a jump of either.
double path_velocity(model::MotionPath const& path, state::PathState const& s, double t);

/// Whether all targets have been reached.
bool path_ended(model::MotionPath const& path, state::PathState const& s);

/// Looks at the gauges at time t: begins the path, and turns it for every target that they have reached.
/// `readings` are those of all gauges. The direction of a leg follows from where its gauge stands: the path
/// moves with +speed if the gauge is to rise, -speed if it is to fall. Returns how many targets were reached.
int follow_path(model::MotionPath const& path, state::PathState& s, double t,
                std::vector<double> const& readings);

} // namespace fissura::loads
