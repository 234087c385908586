#pragma once
// How bar elements and bar joints have moved, from the displacements of their host tets. Nodal arrays hold x,
// y, z, 0 of node 4 tet + corner from entry 4 (4 tet + corner). Nothing here allocates.
#include <array>

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
ElementStretch stretch_of(model::BarElement const& e, Nodes const& nodes);

/// How far a bar joint has opened. The transverse directions turn with tet_a.
struct JointJump {
  Vec3 d;                  ///< x_PB - x_PA [m]
  Vec3 r;                  ///< unit mean direction of the two bar elements
  Vec3 across_1, across_2; ///< unit vectors normal to r and to each other
  double axial = 0;        ///< d.r [m]
  double t_1 = 0, t_2 = 0; ///< half of d along across_1 and across_2: t_v of the theory [m]
};
JointJump jump_of(model::BarJoint const& j, Vec3 direction_a, Vec3 direction_b, Nodes const& nodes);

/// Barycentric weights, in the tet as it is now, of its point with weights w moved by `step` [m]. A force at
/// a point common to both tets has no couple only if it is shared out by these. The change of the weights is
/// limited to 1.
std::array<double, 4> moved_weights(int tet, std::array<double, 4> const& w, Vec3 step, Nodes const& nodes);

} // namespace fissura::rebar
