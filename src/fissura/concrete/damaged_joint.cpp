// A joint with a history: three integration points by the full law, one joint at a time.
#include <algorithm>
#include <cmath>

#include "fissura/concrete/concrete.hpp"

namespace fissura::concrete {

using model::Model;
using state::JointStatus;
using state::State;

namespace {

Vec3 displacement(State const& s, int node, double back) {
  double const *u = s.u.data() + 4 * node, *v = s.v.data() + 4 * node;
  return {u[0] - back * v[0], u[1] - back * v[1], u[2] - back * v[2]};
}

Vec3 reference_edge(Model const& m, int joint, int which) {
  auto const j = static_cast<std::size_t>(joint);
  auto const& e = m.joints.edge;
  return {e[model::at(j, 3 * which, 6)], e[model::at(j, 3 * which + 1, 6)],
          e[model::at(j, 3 * which + 2, 6)]};
}

/// A crack-face pair lets go once its faces overlap by less than half and none of its points presses.
bool has_slid_off(model::Joint const& joint, JointKinematics const& k) {
  double slid = 0;
  for (auto const& p : k.at) {
    if (p.opening < 0) return false;
    slid = std::max(slid, std::hypot(p.sliding_1, p.sliding_2));
  }
  return slid > 0.5 * std::sqrt(2 * joint.area);
}

} // namespace

JointKinematics joint_kinematics(Model const& m, State const& s, int joint, double back) {
  auto const& j = m.joints.joints[joint];
  std::array<Vec3, 3> jump, mean;
  for (int k = 0; k < 3; ++k) {
    Vec3 const ua = displacement(s, j.node_a[k], back), ub = displacement(s, j.node_b[k], back);
    jump[k] = ub - ua;
    mean[k] = 0.5 * (ua + ub);
  }
  Vec3 const e1 = reference_edge(m, joint, 0) + (mean[1] - mean[0]);
  Vec3 const e2 = reference_edge(m, joint, 1) + (mean[2] - mean[0]);
  JointKinematics r;
  r.normal = unit(cross(e1, e2));
  r.axis_1 = unit(e1);
  r.axis_2 = cross(r.normal, r.axis_1);
  for (int q = 0; q < 3; ++q) {
    Vec3 const d = 0.5 * (jump[q] + jump[(q + 1) % 3]);
    r.at[q] = {dot(d, r.normal), dot(d, r.axis_1), dot(d, r.axis_2)};
  }
  return r;
}

void damaged_joint(Model const& m, State& s, double* joint_force, int joint) {
  auto& status = s.joint_status[joint];
  auto const& j = m.joints.joints[joint];
  auto& history = s.joint_history[joint];
  double* const force = joint_force + 12 * static_cast<std::size_t>(joint);
  if (status == static_cast<std::uint8_t>(JointStatus::released)) {
    std::fill(force, force + 12, 0.0);
    return;
  }
  JointKinematics const now = joint_kinematics(m, s, joint);
  if (status == static_cast<std::uint8_t>(JointStatus::intact))
    history.last = joint_kinematics(m, s, joint, m.dt).at;
  bool const broken = status == static_cast<std::uint8_t>(JointStatus::broken);
  std::array<Vec3, 3> traction;
  bool any_damage = false, all_failed = true;
  for (int q = 0; q < 3; ++q) {
    laws::Dissipation lost{};
    auto const t = laws::cohesive_traction(m.joints.law[joint], history.point[q], now.at[q], history.last[q],
                                           broken, lost);
    traction[q] = t.sigma * now.normal + t.tau_1 * now.axis_1 + t.tau_2 * now.axis_2;
    history.dissipated.mode_I += lost.mode_I * j.area / 3;
    history.dissipated.mode_II += lost.mode_II * j.area / 3;
    history.dissipated.friction += lost.friction * j.area / 3;
    any_damage |= history.point[q].kappa > 0;
    all_failed &= history.point[q].kappa >= 1;
  }
  history.last = now.at;
  if (any_damage && status == static_cast<std::uint8_t>(JointStatus::intact))
    status = static_cast<std::uint8_t>(JointStatus::damaged);
  if (all_failed && !broken) {
    status = static_cast<std::uint8_t>(JointStatus::broken);
    history.time_of_failure = s.time;
  }
  if (broken && has_slid_off(j, now)) status = static_cast<std::uint8_t>(JointStatus::released);

  // Half of each point's share (area/3) to each node of its edge.
  for (int k = 0; k < 3; ++k) {
    Vec3 const f = (j.area / 6) * (traction[k] + traction[(k + 2) % 3]);
    force[4 * k] = f.x, force[4 * k + 1] = f.y, force[4 * k + 2] = f.z, force[4 * k + 3] = 0;
  }
}

} // namespace fissura::concrete
