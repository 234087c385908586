#pragma once
// Everything that changes in time and must survive a restart. Scratch holds what may be lost.
#include <array>
#include <cstdint>
#include <vector>

#include "fissura/core/buffer.hpp"
#include "fissura/core/node_field.hpp"
#include "fissura/state/bar_state.hpp"
#include "fissura/state/contact_state.hpp"
#include "fissura/state/joint_batch.hpp"
#include "fissura/state/joint_history.hpp"
#include "fissura/state/kinetic.hpp"
#include "fissura/state/overlay.hpp"
#include "fissura/state/point_rows.hpp"
#include "fissura/state/rigid_state.hpp"

namespace fissura::state {

/// What has become of a joint. A broken one is a crack-face pair: it carries compression and friction. A
/// parting one has slid so far that it hands its load over to contact; a released one carries nothing.
enum class JointStatus : std::uint8_t { intact = 0, damaged = 1, broken = 2, parting = 3, released = 4 };

/// Strain rate at a joint whose strength depends on it, while it is stressed beyond half of its strength.
struct JointRate {
  std::array<double, 3> sum; ///< weighted sum of the rates of strain on its plane [1/s]
  double weight;             ///< sum of the weights
  long last_step;            ///< of the last sample
  double excess;             ///< factor on its strengths, less 1
  bool frozen;               ///< it has been damaged
};

/// Where a MotionPath is: which target it is on its way to, and its last turn.
struct PathState {
  int target = -1;         ///< -1 = not begun; as many as there are targets: all reached
  bool rising = false;     ///< the gauge is to rise to the target
  double turned_at = 0;    ///< [s]
  double velocity = 0;     ///< when the turn began [m/s]
  double acceleration = 0; ///< when the turn began [m/s2]
  double toward = 0;       ///< velocity after the turn [m/s]
};

/// The accounts of the energy ledger [J]. Work is put in, everything else is where it went.
struct Ledger {
  double work_supports = 0, work_forces = 0, work_gravity = 0; ///< external work up to u_n
  double viscous = 0, mass_damping = 0, local_damping = 0;     ///< dissipated
  double contact_friction = 0, absorbed = 0;                   ///< dissipated
  double joint_inertia = 0;                                    ///< vanished with joints that were released
  double start = 0;          ///< held at t = 0 (prestressed bars, bodies in motion)
  double kinetic_before = 0; ///< kinetic energy one step ago
  double absolute_work = 0;  ///< sum of |dW| of each account of work, summed over the body before
};

struct State {
  /// Time of the loads, `ahead` seconds after now: with pace control (sim/pace.hpp) it runs faster than time.
  double load_time(double ahead = 0) const { return time + lead + pace * ahead; }

  long step = 0;                           ///< completed steps: u is at step * dt
  double time = 0;                         ///< [s]
  int stage = 0;                           ///< current stage
  core::NodeField u;                       ///< displacements at step n [m]
  core::NodeField v;                       ///< velocities at n - 1/2 [m/s]
  core::Buffer<std::uint8_t> joint_status; ///< JointStatus, padded to blocks
  JointHistories joint_history;
  core::Buffer<JointRate> joint_rate; ///< empty unless some strength depends on the strain rate
  BarState bars;
  RigidState rigid;
  ContactState contact;
  std::vector<double> reaction;            ///< per Prescribed: sum of reactions at step n [N]
  std::vector<double> prescribed_velocity; ///< per Prescribed: at n - 1/2 [m/s]
  std::vector<std::uint8_t> held;          ///< per Prescribed: has begun
  std::vector<PathState> paths;            ///< per MotionPath
  double pace = 1, pace_growth = 1;        ///< seconds of the loads' curves per second; its factor per step
  double lead = 0;                         ///< by which the loads are ahead of the time [s]
  std::vector<double> stage_start; ///< actual start of each stage in load time (a stage may end early) [s]
  Ledger ledger;
};

/// Sums over chunks of tets that one step leaves behind.
struct TetSums {
  double viscous = 0, local_damping = 0; ///< [J] dissipated in this step
  double gravity = 0;                    ///< [J] work of gravity over u_n -> u_(n+1)
  Kinetic kinetic;
  TetSums& operator+=(TetSums const& b) {
    viscous += b.viscous, local_damping += b.local_damping, gravity += b.gravity, kinetic += b.kinetic;
    return *this;
  }
};

/// How many lanes of a group of joints are taken: at its front, and at its far end.
struct LaneCounts {
  int at_work = 0, released = 0;
};

/// The forces of the joints, and where each tet finds those of its faces. A joint has one slot, which its
/// side b takes with the opposite sign; once it is damaged side b has a slot of its own
/// (concrete::separate_sides).
struct JointSlots {
  static constexpr std::size_t per_slot = 3 * core::per_node;
  std::size_t joints = 0;           ///< padded to blocks
  core::Buffer<double> force;       ///< slots of 9, corner by corner: x, y, z [N]
  core::Buffer<int> place;          ///< [block][12][8] face by face, corner by corner: where its force starts
  core::Buffer<float> sign;         ///< [block][4][8] +1, -1, 0 per face
  std::vector<double> laws;         ///< those that occur, in the order of state/joint_batch.hpp
  std::vector<LaneCounts> lanes;    ///< per group of JointHistories
  core::Buffer<JointBatch> batches; ///< as JointHistories::rows

  /// Where the force on side a of a joint starts.
  std::size_t side_a(int joint) const { return per_slot * static_cast<std::size_t>(joint); }
  /// Where the force on side b of a damaged joint starts.
  std::size_t side_b(int joint) const { return per_slot * (joints + static_cast<std::size_t>(joint)); }
  /// What released joints exert.
  std::size_t zeros() const { return 2 * per_slot * joints; }
  /// Where idle lanes of a group put their forces: nobody reads them.
  std::size_t nobody(std::size_t in_group) const { return zeros() + 16 * (1 + in_group); }
};

struct Scratch {
  JointSlots joints;
  core::NodeField corner_force; ///< used only with bonded nodes and joint inertia [N]
  PointRows points;             ///< used only with joint inertia
  Overlay overlay;
  BarScratch bars;
  RigidScratch rigid;
  ContactScratch contact;
  std::vector<TetSums> tet_sums;     ///< per chunk
  std::vector<Vec3> velocity_before; ///< per patch of Model::absorbing: at n - 1/2 [m/s]
  std::vector<double> driven;        ///< per Prescribed: the velocity at n + 1/2 [m/s]
};

inline JointStatus status_of(State const& s, int joint) {
  return static_cast<JointStatus>(s.joint_status[static_cast<std::size_t>(joint)]);
}
inline void set_status(State& s, int joint, JointStatus status) {
  s.joint_status[static_cast<std::size_t>(joint)] = static_cast<std::uint8_t>(status);
}

/// How many lanes the joints of a group take, by their status.
inline LaneCounts count_lanes(State const& s, std::size_t group) {
  LaneCounts n;
  int const first = static_cast<int>(JointHistories::first_of(group)),
            end = first + static_cast<int>(s.joint_history.room(group));
  for (int j = first; j < end; ++j) {
    auto const status = status_of(s, j);
    n.at_work += status != JointStatus::intact && status != JointStatus::released;
    n.released += status == JointStatus::released;
  }
  return n;
}

/// Factor by which the strain rate raises the strengths of a joint.
inline double strength_factor(State const& s, int joint) {
  return s.joint_rate.size() == 0 ? 1 : 1 + s.joint_rate[static_cast<std::size_t>(joint)].excess;
}

} // namespace fissura::state
