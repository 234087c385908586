#include "fissura/rebar/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace fissura::rebar {

ElementStretch stretch_of(model::BarElement const& e, Nodes const& nodes) {
  Vec3 du;
  for (int c = 0; c < 4; ++c) du += (e.w1[c] - e.w0[c]) * nodes.displacement(e.tet, c);
  Vec3 const now = e.axis + du;
  double const length = norm(now);
  // l^2 - l_i^2 = du.(2 axis + du): no difference of nearly equal lengths
  return {dot(du, e.axis + now) / (length + e.length), length > 0 ? now / length : Vec3{}};
}

JointJump jump_of(model::BarJoint const& j, Vec3 direction_a, Vec3 direction_b, Nodes const& nodes) {
  JointJump k;
  k.r = unit(direction_a + direction_b);
  k.d = nodes.displacement(j.tet_b, j.w_b) - nodes.displacement(j.tet_a, j.w_a);
  Vec3 const edge = nodes.current(j.tet_a, j.frame_edge[1]) - nodes.current(j.tet_a, j.frame_edge[0]);
  k.across_1 = unit(edge - dot(edge, k.r) * k.r);
  k.across_2 = cross(k.r, k.across_1);
  k.axial = dot(k.d, k.r);
  k.t_1 = 0.5 * dot(k.d, k.across_1);
  k.t_2 = 0.5 * dot(k.d, k.across_2);
  return k;
}

std::array<double, 4> moved_weights(int tet, std::array<double, 4> const& w, Vec3 step, Nodes const& nodes) {
  Vec3 const x0 = nodes.current(tet, 0);
  Vec3 const a = nodes.current(tet, 1) - x0, b = nodes.current(tet, 2) - x0, c = nodes.current(tet, 3) - x0;
  double const det = dot(a, cross(b, c));
  if (!(det > 0)) return w; // an inverted tet has no inside
  Vec3 change{dot(step, cross(b, c)) / det, dot(step, cross(c, a)) / det, dot(step, cross(a, b)) / det};
  double const largest = std::max({std::abs(change.x), std::abs(change.y), std::abs(change.z)});
  if (largest > 1) change = change / largest;
  return {w[0] - change.x - change.y - change.z, w[1] + change.x, w[2] + change.y, w[3] + change.z};
}

} // namespace fissura::rebar
