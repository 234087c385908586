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
  double start = 0; ///< of a curve that begins in mid-run [s]; with stage = -1
};

/// One component of a set of nodes that follows a prescribed motion (a support: none) from the start of its
/// stage, and from where it is then; before, the nodes are free.
struct Prescribed {
  std::string name;
  int axis = 0;
  bool is_velocity = false;
  TimedCurve motion;
  std::vector<int> nodes; ///< all copies, ascending
  int path = -1;          ///< follows `scale` times Model::paths[path] instead of the curve
  double scale = 1;
};

/// A velocity to and fro that turns when gauges reach their targets.
struct MotionPath {
  struct Target {
    int gauge = 0;    ///< index into Case::gauges
    double value = 0; ///< in the unit of the gauge
  };
  std::string name; ///< of the motion that brought it
  int stage = -1;   ///< begins with this stage
  double speed = 0; ///< [m/s]
  double turn = 0;  ///< duration of a reversal [s]
  bool stops = true;
  std::vector<Target> targets;
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

/// Dashpots on boundary faces, gathered to the nodes that move as one: force = -damping v.
struct Absorbing {
  struct Patch {
    int begin = 0, end = 0;  ///< its nodes: Absorbing::node[begin .. end)
    Mat3 damping;            ///< symmetric, not negative [N s/m]; no row or column for what a support holds
    double mass = 0;         ///< of all its nodes [kg]
    double weight_ratio = 1; ///< real mass over scaled mass
  };
  std::vector<Patch> patches; ///< by their first node
  std::vector<int> node;
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
