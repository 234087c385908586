// Joints with a history: what is rare is done joint by joint, the law in batches.
#include "fissura/concrete/damaged_joints.hpp"

#include <algorithm>

#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/joint_batch.hpp"
#include "fissura/concrete/kernels.hpp"
#include "fissura/concrete/parting.hpp"
#include "fissura/concrete/strain_rate.hpp"

namespace fissura::concrete {

using model::Model;
using state::JointStatus;
using state::State;

namespace {

JointStatus status_of(State const& s, int joint) {
  return static_cast<JointStatus>(s.joint_status[static_cast<std::size_t>(joint)]);
}
void set_status(State& s, int joint, JointStatus status) {
  s.joint_status[static_cast<std::size_t>(joint)] = static_cast<std::uint8_t>(status);
}

/// What seldom happens to a joint, before its law is asked.
void prepare(Model const& m, State& s, int joint) {
  auto& history = s.joint_history[static_cast<std::size_t>(joint)];
  auto const was = status_of(s, joint);
  if (was == JointStatus::intact) {
    history.last = joint_kinematics(m, s, joint, m.dt).at;
  } else if (history.farthest >= least_parting(m.joints.joints[joint].area)) {
    auto const now = joint_kinematics(m, s, joint);
    was == JointStatus::damaged ? break_at_hinge(m, joint, now, history) : hand_over(m, s, joint, now);
  }
  if (m.joints.any_rate) follow_strain_rate(m, s, joint, joint_kinematics(m, s, joint).normal);
}

void fill(Model const& m, State& s, state::JointSlots const& slots, JointBatch& b, int lane) {
  int const joint = b.joint[lane];
  auto const j = static_cast<std::size_t>(joint);
  for (int i = 0; i < 6; ++i) {
    b.node[i][lane] = m.joints.node[model::at(j, i, 6)];
    b.edge[i][lane] = m.joints.edge[model::at(j, i, 6)];
  }
  b.history[lane] = state::JointHistory::doubles * joint;
  b.force_a[lane] = static_cast<int>(slots.side_a(joint));
  b.force_b[lane] = static_cast<int>(slots.side_b(joint));
  b.law[lane] = doubles_per_law * m.joints.kind[j];
  b.k[lane] = m.joints.k(j);
  b.weight[lane] = m.joints.stiffness[model::at(j, 1, 2)];
  b.strength[lane] = 1 + (s.joint_rate.empty() ? 0 : s.joint_rate[j].excess);
  b.broken[lane] = status_of(s, joint) >= JointStatus::broken ? 1 : 0;
}

/// What the joint has become.
void renew_status(Model const& m, State& s, state::JointSlots& slots, JointBatch const& b, int lane) {
  int const joint = b.joint[lane];
  auto const was = status_of(s, joint);
  if (was == JointStatus::released) return remove_from_slots(m, slots, joint);
  if (was >= JointStatus::broken || b.damaged[lane] == 0) return;
  if (was == JointStatus::intact) {
    separate_sides(m, slots, joint);
    if (s.joint_rate.size() > 0) s.joint_rate[static_cast<std::size_t>(joint)].frozen = true;
    set_status(s, joint, JointStatus::damaged);
  }
  if (b.failed[lane] == 0) return;
  set_status(s, joint, JointStatus::broken);
  s.joint_history[static_cast<std::size_t>(joint)].time_of_failure = s.time;
}

/// Histories lie far apart; fetching those of the next batch while this one is at work hides the way.
void prefetch(State const& s, int const* joints, int count) {
  for (int i = 0; i < std::min(count, JointBatch::width); ++i) {
    auto const* const history = reinterpret_cast<char const*>(&s.joint_history[joints[i]]);
    for (std::size_t line = 0; line < sizeof(state::JointHistory); line += 64)
      __builtin_prefetch(history + line, 1);
  }
}

} // namespace

void damaged_joints(KernelSet const& kernels, Model const& m, State& s, state::JointSlots& slots,
                    int const* joints, int count) {
  DamagedPass const pass{s.u.data(), slots.laws.data(), reinterpret_cast<double*>(s.joint_history.data()),
                         slots.force.data()};
  JointBatch b;
  prefetch(s, joints, count);
  for (int first = 0; first < count; first += JointBatch::width) {
    b.count = std::min(JointBatch::width, count - first);
    prefetch(s, joints + first + b.count, count - first - b.count);
    for (int lane = 0; lane < b.count; ++lane) prepare(m, s, joints[first + lane]);
    for (int lane = 0; lane < JointBatch::width; ++lane) {
      b.joint[lane] = joints[first + std::min(lane, b.count - 1)];
      fill(m, s, slots, b, lane);
    }
    kernels.act_batch(pass, b);
    for (int lane = 0; lane < b.count; ++lane) renew_status(m, s, slots, b, lane);
  }
}

} // namespace fissura::concrete
