// Joints with a history: what is rare is done joint by joint, the law in batches.
#include "fissura/concrete/damaged_joints.hpp"

#include <algorithm>

#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/joint_lanes.hpp"
#include "fissura/concrete/kernels.hpp"
#include "fissura/concrete/parting.hpp"
#include "fissura/concrete/strain_rate.hpp"

namespace fissura::concrete {

using model::Model;
using state::JointBatch;
using state::JointStatus;
using state::State;

namespace {

/// Whether nothing has to be done for a joint in the next step, if nothing happens to it in this one.
bool is_settled(Model const& m, State const& s, int joint) {
  auto const j = static_cast<std::size_t>(joint);
  auto const status = state::status_of(s, joint);
  return (status == JointStatus::damaged || status == JointStatus::broken) &&
         s.joint_history.of(j).farthest_squared < least_parting(m.joints.joints[joint].area) &&
         (s.joint_rate.empty() || s.joint_rate[j].frozen);
}

/// What seldom happens to a joint with a history, before its law is asked.
void care_for(JointLanes const& lanes, int lane) {
  auto& [m, s, slots, group] = lanes;
  int const joint = lanes.joint(lane);
  if (s.joint_history.of(static_cast<std::size_t>(joint)).farthest_squared >=
      least_parting(m.joints.joints[joint].area)) {
    auto const now = joint_kinematics(m, s, joint);
    state::status_of(s, joint) == JointStatus::damaged ? break_at_hinge(m, s, joint, now)
                                                       : hand_over(m, s, joint, now);
  }
  if (m.joints.any_rate) follow_strain_rate(m, s, joint, joint_kinematics(m, s, joint).normal);
  fill_lane(m, s, slots, lane, joint);
}

/// A joint that was intact so far takes a lane for this step.
void let_in(JointLanes const& lanes, int lane, int joint) {
  auto& [m, s, slots, group] = lanes;
  state::JointHistory history;
  history.last = joint_kinematics(m, s, joint, m.dt).at;
  if (m.joints.any_rate) follow_strain_rate(m, s, joint, joint_kinematics(m, s, joint).normal);
  lanes.take(lane, joint, history);
}

/// What the joint has become.
void renew_status(JointLanes const& lanes, int lane) {
  auto& [m, s, slots, group] = lanes;
  JointBatch const& b = lanes.batch(lane);
  int const joint = lanes.joint(lane), at = lane % model::block;
  auto const j = static_cast<std::size_t>(joint);
  auto const was = state::status_of(s, joint);
  if (was >= JointStatus::broken || b.damaged[at] == 0) return;
  if (was == JointStatus::intact) {
    separate_sides(m, slots, joint);
    if (!s.joint_rate.empty()) s.joint_rate[j].frozen = true;
    state::set_status(s, joint, JointStatus::damaged);
  }
  if (b.failed[at] == 0) return;
  state::set_status(s, joint, JointStatus::broken);
  auto history = s.joint_history.of(j);
  history.time_of_failure = s.time;
  s.joint_history.set(j, history);
}

/// Those let in for this step stay if they are damaged now.
void keep_damaged(JointLanes const& lanes, int end) {
  int& at_work = lanes.counts().at_work;
  for (int lane = at_work; lane < end; ++lane) {
    if (state::status_of(lanes.s, lanes.joint(lane)) == JointStatus::intact)
      lanes.clear(lane);
    else if (int const to = at_work++; to != lane)
      lanes.move(lane, to);
  }
}

/// From the last one on, so that those who take their lanes have been looked at.
void retire_released(JointLanes const& lanes) {
  for (int lane = lanes.counts().at_work - 1; lane >= 0; --lane) {
    int const joint = lanes.joint(lane);
    if (state::status_of(lanes.s, joint) != JointStatus::released) continue;
    remove_from_slots(lanes.m, lanes.slots, joint);
    lanes.retire(lane);
  }
}

/// The law of one batch. Returns whether something may have happened to its joints.
bool act(JointLanes const& lanes, KernelSet const& kernels, DamagedPass const& pass, int first) {
  JointBatch& b = lanes.batch(first);
  bool const had_care = b.needs_care;
  if (had_care) {
    for (int lane = first; lane < first + b.count; ++lane)
      if (state::status_of(lanes.s, lanes.joint(lane)) != JointStatus::intact) care_for(lanes, lane);
    b.has_one_law = std::all_of(b.law.begin(), b.law.end(), [&](int law) { return law == b.law[0]; });
  }
  kernels.act_batch(pass, b, lanes.s.joint_history.rows[lanes.row(first)]);
  if (!had_care && !b.has_event) return false;
  b.needs_care = b.has_event;
  for (int lane = first; lane < first + b.count; ++lane) {
    renew_status(lanes, lane);
    b.needs_care |= !is_settled(lanes.m, lanes.s, lanes.joint(lane));
  }
  return true;
}

} // namespace

void damaged_joints(KernelSet const& kernels, Model const& m, State& s, state::JointSlots& slots,
                    std::size_t group, int const* fresh, int count) {
  DamagedPass const pass{s.u.data(), slots.laws.data(), slots.force.data()};
  JointLanes const lanes{m, s, slots, group};
  int const at_work = lanes.counts().at_work, end = at_work + count;
  for (int i = 0; i < count; ++i) let_in(lanes, at_work + i, fresh[i]);
  if (count > 0) set_taken(slots, group, end);
  bool is_new = false;
  for (int first = 0; first < end; first += JointBatch::width) is_new |= act(lanes, kernels, pass, first);
  if (!is_new) return;
  keep_damaged(lanes, end);
  retire_released(lanes);
  set_taken(slots, group, lanes.counts().at_work);
}

} // namespace fissura::concrete
