#pragma once
// Supports, prescribed motions and applied forces, resolved to nodes.
#include <string>
#include <vector>

#include "fissura/core/vec3.hpp"
#include "fissura/model/case.hpp"

namespace fissura::model {

/// A curve that starts with a stage (-1: with the run). When a stage starts is known only as the run goes:
/// see State::stage_start.
struct TimedCurve {
  Curve curve;
  int stage = -1;
};

/// One component of a set of nodes that follows a prescribed motion (a support: none) from the start of its
/// stage, and from where it is then; before, the nodes are free.
struct Prescribed {
  std::string name;
  int axis = 0;
  bool is_velocity = false;
  TimedCurve motion;
  std::vector<int> nodes; ///< all copies, ascending
};

/// A force on corners of tets: pattern times curve.
struct AppliedForce {
  struct Entry {
    int slot, corner; ///< in the overlay
    Vec3 share;       ///< [-] for forces, [m2] for tractions
  };
  std::string name;
  TimedCurve curve; ///< [N] or [Pa]
  std::vector<Entry> entries;

  /// Sum of the shares: the force at a curve value of 1.
  Vec3 total() const {
    Vec3 sum;
    for (auto const& e : entries) sum += e.share;
    return sum;
  }
};

struct Gravity {
  bool on = false;
  Vec3 direction;
  TimedCurve curve; ///< [m/s2]
};

struct Stage {
  std::string name;
  double duration = 0; ///< [s] at most
  double mass_damping = 0, local_damping = 0, settle = 0;
};

} // namespace fissura::model
