#pragma once
// Whether inertia took part in a run, judged from readings of its energies and forces. What rings to and fro
// is no inertia that a measured load holds: readings are smoothed over the longest vibration that the forces
// show before they are judged (docs/reference/report.md states the rule).
#include <tuple>
#include <vector>

#include "fissura/core/vec3.hpp"

namespace fissura::sim {

/// One reading of the ledger and of the forces on the whole body.
struct Reading {
  double time = 0;                  ///< [s]
  double kinetic = 0, internal = 0; ///< [J]
  Vec3 resultant;                   ///< of reactions, applied forces, rigid bodies and weight [N]
  double forces = 0;                ///< half the sum of their sizes: each force and what holds it [N]

  using ListGrows = void;
  static auto fields(auto& self) {
    return std::tie(self.time, self.kinetic, self.internal, self.resultant, self.forces);
  }
};

inline constexpr double quiet_ratio = 0.05;   ///< kinetic over internal energy of a quiet reading, at most
inline constexpr double quiet_share = 0.9;    ///< share of quiet time of a quasi-static run, more than
inline constexpr double balance_limit = 0.05; ///< imbalance of a quasi-static run, less than

struct Inertia {
  double period = 0;      ///< of the longest vibration seen in the resultant [s]; 0 = none
  double quiet_share = 0; ///< of the time with internal energy above 1 % of its largest value
  double imbalance = 0;   ///< mean resultant over mean forces: 0 = equilibrium

  bool is_quasi_static() const { return quiet_share > sim::quiet_share && imbalance < balance_limit; }
};

/// Readings in the order of time.
Inertia judge_inertia(std::vector<Reading> const& readings);

} // namespace fissura::sim
