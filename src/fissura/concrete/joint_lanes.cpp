#include "fissura/concrete/joint_lanes.hpp"

#include <algorithm>

namespace fissura::concrete {

using model::Model;
using state::JointBatch;
using state::JointHistories;
using state::JointStatus;
using state::State;

namespace {

void idle_behind(JointBatch& b, int nobody) {
  for (auto at = static_cast<std::size_t>(b.count); at < JointBatch::width; ++at) {
    for (int i = 0; i < 3; ++i) b.node[i][at] = b.node[i + 3][at] = b.node[i][0];
    for (auto& edge : b.edge) edge[at] = edge[0];
    b.force_a[at] = b.force_b[at] = nobody;
    b.law[at] = b.law[0];
    b.k[at] = b.k[0], b.per_k[at] = b.per_k[0], b.weight[at] = b.weight[0];
    b.strength[at] = 1;
    b.broken[at] = b.damaged[at] = b.failed[at] = 0;
  }
}

} // namespace

void fill_lane(Model const& m, State const& s, state::JointSlots& slots, int lane, int joint) {
  auto const j = static_cast<std::size_t>(joint);
  std::size_t const place = JointHistories::place(j / JointHistories::group, lane), at = place % model::block;
  JointBatch& b = slots.batches[place / model::block];
  b.joint[at] = joint;
  for (int i = 0; i < 6; ++i) {
    b.node[i][at] = m.joints.node[model::at(j, i, 6)];
    b.edge[i][at] = m.joints.edge[model::at(j, i, 6)];
  }
  b.force_a[at] = static_cast<int>(slots.side_a(joint));
  b.force_b[at] = static_cast<int>(slots.side_b(joint));
  b.law[at] = state::doubles_per_law * m.joints.kind[j];
  b.k[at] = m.joints.k(j);
  b.per_k[at] = 1 / b.k[at];
  b.weight[at] = m.joints.stiffness[model::at(j, 1, 2)];
  b.strength[at] = state::strength_factor(s, joint);
  auto const status = state::status_of(s, joint);
  b.broken[at] = status >= JointStatus::broken ? 1 : 0;
  b.damaged[at] = status >= JointStatus::damaged ? 1 : 0;
  b.failed[at] = b.broken[at];
  b.needs_care = true;
}

void set_taken(state::JointSlots& slots, std::size_t group, int taken) {
  for (int first = 0; first < taken; first += JointBatch::width) {
    JointBatch& b = slots.batches[JointHistories::place(group, first) / model::block];
    b.count = std::min(taken - first, JointBatch::width);
    idle_behind(b, static_cast<int>(slots.nobody(group)));
  }
}

void JointLanes::take(int lane, int joint, state::JointHistory const& history) const {
  auto const j = static_cast<std::size_t>(joint);
  s.joint_history.lane[j] = static_cast<std::uint8_t>(lane);
  s.joint_history.set(j, history);
  fill_lane(m, s, slots, lane, joint);
}

void JointLanes::clear(int lane) const {
  s.joint_history.rows[row(lane)].set(static_cast<std::size_t>(lane % model::block), {});
}

void JointLanes::move(int from, int to) const {
  int const who = joint(from);
  take(to, who, s.joint_history.of(static_cast<std::size_t>(who)));
  clear(from);
}

void JointLanes::retire(int lane) const {
  auto const who = static_cast<std::size_t>(joint(lane));
  auto const history = s.joint_history.of(who);
  int const last = --counts().at_work;
  clear(lane);
  if (last != lane) move(last, lane);
  int const far = static_cast<int>(s.joint_history.room(group)) - ++counts().released;
  s.joint_history.lane[who] = static_cast<std::uint8_t>(far);
  s.joint_history.set(who, history);
}

} // namespace fissura::concrete
