// Joints with a history: what is rare is done joint by joint, the law in batches.
#include "fissura/concrete/damaged_joints.hpp"

#include <algorithm>

#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/kernels.hpp"
#include "fissura/concrete/parting.hpp"
#include "fissura/concrete/strain_rate.hpp"

namespace fissura::concrete {

using model::Model;
using state::JointBatch;
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
    was == JointStatus::damaged ? break_at_hinge(m, s, joint, now) : hand_over(m, s, joint, now);
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
  b.law[lane] = state::doubles_per_law * m.joints.kind[j];
  b.k[lane] = m.joints.k(j);
  b.per_k[lane] = 1 / b.k[lane];
  b.weight[lane] = m.joints.stiffness[model::at(j, 1, 2)];
  b.strength[lane] = 1 + (s.joint_rate.empty() ? 0 : s.joint_rate[j].excess);
  auto const status = status_of(s, joint);
  b.broken[lane] = status >= JointStatus::broken ? 1 : 0;
  b.damaged[lane] = status >= JointStatus::damaged ? 1 : 0;
  b.failed[lane] = b.broken[lane];
}

/// Whether nothing has to be prepared for a joint in the next step, if nothing happens to it in this one.
bool is_settled(Model const& m, State const& s, int joint) {
  auto const j = static_cast<std::size_t>(joint);
  auto const status = status_of(s, joint);
  return (status == JointStatus::damaged || status == JointStatus::broken) &&
         s.joint_history[j].farthest < least_parting(m.joints.joints[joint].area) &&
         (s.joint_rate.empty() || s.joint_rate[j].frozen);
}

void collect(Model const& m, State& s, state::JointSlots const& slots, JointBatch& b, int const* joints,
             int count) {
  b.count = count;
  b.is_ready = true;
  for (int lane = 0; lane < count; ++lane) {
    prepare(m, s, joints[lane]);
    b.is_ready &= is_settled(m, s, joints[lane]);
  }
  for (int lane = 0; lane < JointBatch::width; ++lane) {
    b.joint[lane] = joints[std::min(lane, count - 1)];
    fill(m, s, slots, b, lane);
  }
  b.has_one_law = std::all_of(b.law.begin(), b.law.end(), [&](int law) { return law == b.law[0]; });
}

bool is_ready_for(JointBatch const& b, int const* joints, int count) {
  return b.is_ready && b.count == count && std::equal(joints, joints + count, b.joint.begin());
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
                    std::size_t first_block, int const* joints, int count) {
  DamagedPass const pass{s.u.data(), slots.laws.data(), reinterpret_cast<double*>(s.joint_history.data()),
                         slots.force.data()};
  JointBatch* b = slots.batches.data() + first_block;
  prefetch(s, joints, count);
  for (int first = 0; first < count; first += JointBatch::width, ++b) {
    int const taken = std::min(JointBatch::width, count - first);
    prefetch(s, joints + first + taken, count - first - taken);
    if (!is_ready_for(*b, joints + first, taken)) collect(m, s, slots, *b, joints + first, taken);
    kernels.act_batch(pass, *b);
    if (b->is_ready && !b->has_event) continue;
    for (int lane = 0; lane < taken; ++lane) renew_status(m, s, slots, *b, lane);
    b->is_ready &= !b->has_event;
  }
}

} // namespace fissura::concrete
