#pragma once
// Measures of a tetrahedron and places in it: pure functions of its four corners. A tet is positive when
// corner 3 lies on the side of the triangle (0, 1, 2) to which its right-hand normal points.
#include <array>

#include "fissura/core/vec3.hpp"

namespace fissura::geometry {

using Tet = std::array<Vec3, 4>;

/// The matrix whose columns are the edges from corner 0 to corners 1, 2, 3 [m]; [dX] of Eq. 6.
inline Mat3 edge_matrix(Tet const& t) {
  return Mat3::from_columns(t[1] - t[0], t[2] - t[0], t[3] - t[0]);
}
/// Inverse of the edge matrix [1/m]: F = edge_matrix(current) * inverse_edge_matrix(reference). Its rows are
/// the gradients of the barycentric coordinates of corners 1, 2, 3.
inline Mat3 inverse_edge_matrix(Tet const& t) {
  return core::inverse(edge_matrix(t));
}
/// Signed volume [m3].
inline double volume(Tet const& t) {
  return core::dot(t[1] - t[0], core::cross(t[2] - t[0], t[3] - t[0])) / 6;
}
inline Vec3 centroid(Tet const& t) {
  return 0.25 * (t[0] + t[1] + t[2] + t[3]);
}

/// Area vectors [m2] of the faces opposite to corners 0..3, pointing out of a positive tet; they sum to zero.
std::array<Vec3, 4> face_area_vectors(Tet const& t);
/// Distance [m] of each corner from the plane of the opposite face; negative in an inverted tet.
std::array<double, 4> altitudes(Tet const& t);
double smallest_altitude(Tet const& t);
/// Length of the longest edge [m].
double longest_edge(Tet const& t);
/// Inner dihedral angles [rad] at the edges 01, 02, 03, 12, 13, 23 of a positive tet.
std::array<double, 6> dihedral_angles(Tet const& t);
double smallest_dihedral_angle(Tet const& t);
/// Mean-ratio quality 12 (3V)^(2/3) / sum of the squared edges: 1 for the regular tet, 0 for a flat or
/// inverted one.
double mean_ratio(Tet const& t);

/// Edge [m] of the regular tet of this volume: h = (6 sqrt(2) V)^(1/3), the element size of Eq. 13.
double regular_edge(double volume);

/// Barycentric coordinates of p: they sum to 1; all are in [0, 1] where p lies in the tet.
std::array<double, 4> barycentric(Tet const& t, Vec3 p);
/// The point with the given barycentric coordinates.
inline Vec3 at(Tet const& t, std::array<double, 4> const& l) {
  return l[0] * t[0] + l[1] * t[1] + l[2] * t[2] + l[3] * t[3];
}

} // namespace fissura::geometry
