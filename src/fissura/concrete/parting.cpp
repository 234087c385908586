#include "fissura/concrete/parting.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace fissura::concrete {

using model::Model;
using state::JointStatus;
using state::State;

namespace {

constexpr double cos_30 = 0.8660254037844386;

double slid(laws::Separation const& p) {
  return std::hypot(p.sliding_1, p.sliding_2);
}

/// Edge of a right-angled isosceles triangle of the joint's area: the length its sliding is measured by.
double face_size(model::Joint const& joint) {
  return std::sqrt(2 * joint.area);
}

/// Cosine of the angle by which the faces of the two sides have turned against each other, about whatever
/// axis: the least of those between their normals and between their edges. (Faces that twist in their common
/// plane keep their normals, but at 180 degrees nothing would be left of the mid-triangle.) 1 where no node
/// pair is far enough apart for 30 degrees to be possible.
double faces_turned(model::Joint const& joint, JointKinematics const& k) {
  double farthest_squared = 0;
  for (Vec3 const d : k.jump) farthest_squared = std::max(farthest_squared, dot(d, d));
  if (farthest_squared < least_parting(joint.area)) return 1;
  auto edge = [&](int from, double side) {
    int const to = (from + 1) % 3;
    return k.mid[to] - k.mid[from] + side * (k.jump[to] - k.jump[from]);
  };
  auto normal = [&](double side) { return unit(cross(edge(0, side), edge(1, side))); };
  double least = dot(normal(-0.5), normal(0.5));
  for (int i = 0; i < 3; ++i) least = std::min(least, dot(unit(edge(i, -0.5)), unit(edge(i, 0.5))));
  return least;
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

} // namespace

void break_at_hinge(Model const& m, State& s, int joint, JointKinematics const& now) {
  auto const& j = m.joints.joints[joint];
  if (!(faces_turned(j, now) < 0.5)) return;
  auto history = s.joint_history.of(static_cast<std::size_t>(joint));
  auto const law = laws::with_strength(m.joints.law(joint), state::strength_factor(s, joint));
  for (int q = 0; q < 3; ++q) {
    auto& point = history.point[q];
    if (point.kappa >= 1) continue;
    auto const& last = history.last[q];
    auto held = [&](laws::Separation at, laws::CohesiveHistory const& h) {
      return j.area / 3 * laws::cohesive_stored(law, h, at, false);
    };
    laws::CohesiveHistory const at_rest{point.kappa, point.z, point.f_s, last.sliding_1, last.sliding_2},
        opened_only{point.kappa, point.z, point.f_s, 0, 0},
        broken{1, 0, point.f_s, last.sliding_1, last.sliding_2};
    double const cohesive = held(last, at_rest), opening = held({last.opening, 0, 0}, opened_only);
    history.dissipated.friction += held(last, point) - cohesive;
    history.dissipated.mode_II += cohesive - opening;
    history.dissipated.mode_I += opening - held(last, broken); // pressed faces keep what pressure holds
    point = broken;
  }
  s.joint_history.set(static_cast<std::size_t>(joint), history);
}

void hand_over(Model const& m, State& s, int joint, JointKinematics const& now) {
  auto const& j = m.joints.joints[joint];
  auto history = s.joint_history.of(static_cast<std::size_t>(joint));
  double const share = std::max(history.handed_over, handed_over(j, now));
  if (share <= history.handed_over) return;
  if (share < 1 && !m.source.contact.on) return; // nobody there to take it
  for (int q = 0; q < 3; ++q)
    history.dissipated.friction +=
        (share - history.handed_over) * j.area / 3 *
        laws::cohesive_stored(m.joints.law(joint), history.point[q], history.last[q], true);
  history.handed_over = share;
  s.joint_history.set(static_cast<std::size_t>(joint), history);
  bool const was_whole = s.joint_status[joint] == static_cast<std::uint8_t>(JointStatus::broken);
  s.joint_status[joint] = static_cast<std::uint8_t>(share < 1 ? JointStatus::parting : JointStatus::released);
  if (!was_whole) return; // contact sees it already
  std::atomic_ref(s.contact.is_due).store(1, std::memory_order_relaxed);
}

} // namespace fissura::concrete
