#pragma once
// How bar elements and bar joints have moved, from the displacements of their host tets. Nodal arrays hold x,
// y, z, 0 of node 4 tet + corner from entry 4 (4 tet + corner). Nothing here allocates.
#include <algorithm>
#include <array>
#include <cmath>

#include "fissura/core/vec3.hpp"
#include "fissura/model/bars.hpp"

namespace fissura::rebar {

/// Reference positions X and displacements u of all nodes [m].
struct Nodes {
  double const* position;
  double const* u;

  static Vec3 read(double const* a, int node) { return {a[4 * node], a[4 * node + 1], a[4 * node + 2]}; }
  Vec3 displacement(int tet, int corner) const { return read(u, 4 * tet + corner); }
  Vec3 current(int tet, int corner) const {
    return read(position, 4 * tet + corner) + read(u, 4 * tet + corner);
  }
  /// Displacement of the point of a tet with weights w.
  Vec3 displacement(int tet, std::array<double, 4> const& w) const {
    Vec3 d;
    for (int c = 0; c < 4; ++c) d += w[c] * displacement(tet, c);
    return d;
  }
};

/// Elongation l - l_i [m] and current unit direction of a bar element (Eq. 3).
struct ElementStretch {
  double elongation = 0;
  Vec3 direction;
};
inline ElementStretch stretch_of(model::BarElement const& e, Nodes const& nodes) {
  Vec3 du;
  for (int c = 0; c < 4; ++c) du += (e.w1[c] - e.w0[c]) * nodes.displacement(e.tet, c);
  Vec3 const now = e.axis + du;
  double const length = norm(now);
  // l^2 - l_i^2 = du.(2 axis + du): no difference of nearly equal lengths
  return {dot(du, e.axis + now) / (length + e.length), length > 0 ? now / length : Vec3{}};
}

/// How far a bar joint has opened. The transverse directions turn with tet_a.
struct JointJump {
  Vec3 d;                  ///< x_PB - x_PA [m]
  Vec3 r;                  ///< unit mean direction of the two bar elements
  Vec3 across_1, across_2; ///< unit vectors normal to r and to each other
  double axial = 0;        ///< d.r [m]
  double t_1 = 0, t_2 = 0; ///< half of d along across_1 and across_2: t_v of the theory [m]
};
inline JointJump jump_of(model::BarJoint const& j, Vec3 direction_a, Vec3 direction_b, Nodes const& nodes) {
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

/// Gradients of the barycentric coordinates of corners 1, 2 and 3 of a tet as it is now [1/m]. Zero in an
/// inverted tet: it has no inside.
inline std::array<Vec3, 3> gradients_of(int tet, Nodes const& nodes) {
  Vec3 const x0 = nodes.current(tet, 0);
  Vec3 const a = nodes.current(tet, 1) - x0, b = nodes.current(tet, 2) - x0, c = nodes.current(tet, 3) - x0;
  Vec3 const b_c = cross(b, c);
  double const det = dot(a, b_c), inverse = det > 0 ? 1 / det : 0;
  return {inverse * b_c, inverse * cross(c, a), inverse * cross(a, b)};
}

/// Barycentric weights, in the tet as it is now, of its point with weights w moved by `step` [m]. A force at
/// a point common to both tets has no couple only if it is shared out by these. The change of the weights is
/// limited to 1.
inline std::array<double, 4> moved_weights(std::array<Vec3, 3> const& gradients,
                                           std::array<double, 4> const& w, Vec3 step) {
  Vec3 change{dot(step, gradients[0]), dot(step, gradients[1]), dot(step, gradients[2])};
  double const largest = std::max({std::abs(change.x), std::abs(change.y), std::abs(change.z)});
  if (largest > 1) change = change / largest;
  return {w[0] - change.x - change.y - change.z, w[1] + change.x, w[2] + change.y, w[3] + change.z};
}

} // namespace fissura::rebar
