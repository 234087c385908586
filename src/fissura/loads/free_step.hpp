#pragma once
// The tet pass integrates every node as a free one; supports and dashpots correct that afterwards.
#include "fissura/model/loads.hpp"

namespace fissura::loads {

/// The step of one component of one node as the tet pass did it, and how to undo it.
struct FreeStep {
  double keep, scale, alpha, dt, c;

  /// Acceleration without damping, from the velocity before and the one the free node would have reached.
  double acceleration(double before, double free) const {
    double const damped = (free / scale - keep * before) / dt;
    double const sense = before > 0 ? 1 : before < 0 ? -1 : 0;
    double const sign = damped > 0 ? 1 : damped < 0 ? -1 : 0;
    return damped / (1 - alpha * sign * sense);
  }
};

inline FreeStep free_step(model::Stage const& stage, double dt) {
  double const c = stage.mass_damping;
  return {1 - 0.5 * c * dt, 1 / (1 + 0.5 * c * dt), stage.local_damping, dt, c};
}

} // namespace fissura::loads
