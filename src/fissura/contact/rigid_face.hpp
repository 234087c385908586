#pragma once
// A face of a tet as a rigid body sees it: seven quadrature points on a plane triangle.
#include <array>

#include "fissura/core/vec3.hpp"
#include "fissura/mesh/mesh.hpp"
#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::contact {

/// A quadrature point of a triangle: weights of its corners, share of its area. The rule is exact to
/// degree 3.
struct FacePoint {
  std::array<double, 3> corner;
  double share;
};
inline constexpr std::array<FacePoint, 7> face_points{{{{1, 0, 0}, 1.0 / 20},
                                                       {{0, 1, 0}, 1.0 / 20},
                                                       {{0, 0, 1}, 1.0 / 20},
                                                       {{0.5, 0.5, 0}, 2.0 / 15},
                                                       {{0, 0.5, 0.5}, 2.0 / 15},
                                                       {{0.5, 0, 0.5}, 2.0 / 15},
                                                       {{1.0 / 3, 1.0 / 3, 1.0 / 3}, 9.0 / 20}}};

using Triangle = std::array<Vec3, 3>;

inline Vec3 at(Triangle const& x, FacePoint const& q) {
  return q.corner[0] * x[0] + q.corner[1] * x[1] + q.corner[2] * x[2];
}

/// Values of a nodal field at the corners of a face.
inline Triangle on_face(core::NodeField const& field, int tet, int face) {
  Triangle x;
  for (int k = 0; k < 3; ++k) x[k] = field.at(model::node_of(tet, mesh::face_corners[face][k]));
  return x;
}

/// Positions of the corners of a face at u_n [m].
inline Triangle positions(model::Model const& m, state::State const& s, int tet, int face) {
  Triangle x = on_face(m.position, tet, face);
  Triangle const u = on_face(s.u, tet, face);
  for (int k = 0; k < 3; ++k) x[k] += u[k];
  return x;
}

} // namespace fissura::contact
