// A joint with a history: three integration points by the full law, one joint at a time.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/strain_rate.hpp"

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

constexpr double cos_30 = 0.8660254037844386;

double slid(laws::Separation const& p) {
  return std::hypot(p.sliding_1, p.sliding_2);
}

/// Edge of a right-angled isosceles triangle of the joint's area: the length its sliding is measured by.
double face_size(model::Joint const& joint) {
  return std::sqrt(2 * joint.area);
}

/// Cosine of the angle between the faces of the two sides; 1 where no node pair is far enough apart for 30
/// degrees to be possible.
double faces_turned(model::Joint const& joint, JointKinematics const& k) {
  double farthest = 0;
  for (Vec3 const d : k.jump) farthest = std::max(farthest, dot(d, d));
  if (farthest < 0.02 * joint.area) return 1;
  auto normal = [&](double side) {
    Vec3 const a = k.mid[0] + side * k.jump[0];
    return unit(cross(k.mid[1] + side * k.jump[1] - a, k.mid[2] + side * k.jump[2] - a));
  };
  return dot(normal(-0.5), normal(0.5));
}

/// Share of its load that a crack-face pair has handed over to contact: none until its faces overlap by no
/// more than half or have turned by 30 degrees, all once they have slid past each other or turned by 60
/// degrees. At once where they stand wide open, or no point presses.
double handed_over(model::Joint const& joint, JointKinematics const& k) {
  double most = 0;
  bool presses = false, is_wide_open = true;
  for (auto const& p : k.at) {
    most = std::max(most, slid(p) / face_size(joint));
    presses |= p.opening < 0;
    is_wide_open &= p.opening > 0.25 * face_size(joint);
  }
  double const turned = (cos_30 - faces_turned(joint, k)) / (cos_30 - 0.5);
  double const share = std::clamp(std::max(2 * most - 1, turned), 0.0, 1.0);
  return is_wide_open || (share > 0 && !presses) ? 1 : share;
}

/// A joint whose faces have turned by 60 degrees has broken, also where a point on the hinge between them
/// never opened; what that held is lost.
void break_at_hinge(Model const& m, int joint, JointKinematics const& now, state::JointHistory& history) {
  auto const& j = m.joints.joints[joint];
  if (!(faces_turned(j, now) < 0.5)) return;
  for (int q = 0; q < 3; ++q) {
    auto& point = history.point[q];
    if (point.kappa >= 1) continue;
    history.dissipated.mode_I +=
        j.area / 3 * laws::cohesive_stored(m.joints.law[joint], point, history.last[q], false);
    point.kappa = 1, point.z = 0;
  }
}

using NodeForces = std::array<Vec3, 3>;

/// Forces that act alike on both sides of a joint and balance the moment of its tractions. These act on faces
/// that have moved apart by `jump`, so with opposite forces alone a turning pair would gain or lose energy.
/// They turn the mid-triangle as a rigid body would: theta x r, r from its centroid.
NodeForces balancing_forces(std::array<Vec3, 3> const& mid, std::array<Vec3, 3> const& jump,
                            NodeForces const& force) {
  Vec3 const centre = (mid[0] + mid[1] + mid[2]) / 3;
  Vec3 moment;
  Mat3 inertia;
  for (int k = 0; k < 3; ++k) {
    Vec3 const r = mid[k] - centre;
    moment += cross(jump[k], force[k]);
    for (int i = 0; i < 3; ++i) {
      inertia[i][i] += dot(r, r);
      for (int l = 0; l < 3; ++l) inertia[i][l] -= r[i] * r[l];
    }
  }
  Vec3 const theta = 0.5 * (inverse(inertia) * moment);
  NodeForces balance;
  for (int k = 0; k < 3; ++k) balance[k] = cross(theta, mid[k] - centre);
  return balance;
}

/// The load that a crack-face pair gives up goes to contact, which takes it up as the faces close; what the
/// pair held for it one step ago is lost to friction.
void hand_over(Model const& m, State& s, int joint, JointKinematics const& now) {
  auto const& j = m.joints.joints[joint];
  auto& history = s.joint_history[joint];
  double const share = std::max(history.handed_over, handed_over(j, now));
  if (share <= history.handed_over) return;
  if (share < 1 && !m.source.contact.on) return; // nobody there to take it
  for (int q = 0; q < 3; ++q)
    history.dissipated.friction +=
        (share - history.handed_over) * j.area / 3 *
        laws::cohesive_stored(m.joints.law[joint], history.point[q], history.last[q], true);
  history.handed_over = share;
  bool const was_whole = s.joint_status[joint] == static_cast<std::uint8_t>(JointStatus::broken);
  s.joint_status[joint] = static_cast<std::uint8_t>(share < 1 ? JointStatus::parting : JointStatus::released);
  if (!was_whole) return; // contact sees it already
  std::atomic_ref(s.contact.is_due).store(1, std::memory_order_relaxed);
}

void store(double* at, NodeForces const& force) {
  for (int k = 0; k < 3; ++k)
    for (int r = 0; r < 3; ++r) at[4 * k + r] = force[k][r];
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
  r.jump = jump;
  r.mid = {Vec3{}, e1, e2};
  r.normal = unit(cross(e1, e2));
  r.axis_1 = unit(e1);
  r.axis_2 = cross(r.normal, r.axis_1);
  for (int q = 0; q < 3; ++q) {
    Vec3 const d = 0.5 * (jump[q] + jump[(q + 1) % 3]);
    r.at[q] = {dot(d, r.normal), dot(d, r.axis_1), dot(d, r.axis_2)};
  }
  return r;
}

void damaged_joint(Model const& m, State& s, state::JointSlots& slots, int joint) {
  auto const was = static_cast<JointStatus>(s.joint_status[joint]);
  auto const& j = m.joints.joints[joint];
  auto& history = s.joint_history[joint];
  double* const on_a = slots.force.data() + 12 * static_cast<std::size_t>(joint);
  double* const on_b = slots.force.data() + slots.side_b(joint);
  if (was == JointStatus::released) {
    store(on_a, {});
    store(on_b, {});
    return;
  }
  JointKinematics const now = joint_kinematics(m, s, joint);
  if (was == JointStatus::intact) history.last = joint_kinematics(m, s, joint, m.dt).at;
  bool const broken = was >= JointStatus::broken;
  if (was == JointStatus::damaged) break_at_hinge(m, joint, now, history);
  if (broken) hand_over(m, s, joint, now);
  double const kept = 1 - history.handed_over;
  auto const law = laws::with_strength(m.joints.law[joint], follow_strain_rate(m, s, joint, now.normal));

  std::array<Vec3, 3> traction;
  bool any_damage = false, all_failed = true;
  for (int q = 0; q < 3; ++q) {
    laws::Dissipation lost{};
    auto const t = laws::cohesive_traction(law, history.point[q], now.at[q], history.last[q], broken, lost);
    traction[q] = kept * (t.sigma * now.normal + t.tau_1 * now.axis_1 + t.tau_2 * now.axis_2);
    history.dissipated.mode_I += lost.mode_I * j.area / 3;
    history.dissipated.mode_II += lost.mode_II * j.area / 3;
    history.dissipated.friction += kept * lost.friction * j.area / 3;
    any_damage |= history.point[q].kappa > 0;
    all_failed &= history.point[q].kappa >= 1;
  }
  history.last = now.at;

  // Half of each point's share (area/3) to each node of its edge.
  NodeForces force;
  for (int k = 0; k < 3; ++k) force[k] = (j.area / 6) * (traction[k] + traction[(k + 2) % 3]);
  if (!any_damage && !broken) return store(on_a, force);
  if (was == JointStatus::intact) separate_sides(m, slots, joint);
  if (s.joint_rate.size() > 0) s.joint_rate[joint].frozen = true;
  NodeForces const balance = balancing_forces(now.mid, now.jump, force);
  NodeForces opposite;
  for (int k = 0; k < 3; ++k) opposite[k] = balance[k] - force[k], force[k] += balance[k];
  store(on_a, force);
  store(on_b, opposite);

  if (all_failed && !broken) {
    s.joint_status[joint] = static_cast<std::uint8_t>(JointStatus::broken);
    history.time_of_failure = s.time;
  } else if (!broken) {
    s.joint_status[joint] = static_cast<std::uint8_t>(JointStatus::damaged);
  }
}

} // namespace fissura::concrete
