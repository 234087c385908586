#include "fissura/geometry/tet.hpp"

#include <algorithm>
#include <numbers>

namespace fissura::geometry {

using core::cross;
using core::dot;
using core::norm;

std::array<Vec3, 4> face_area_vectors(Tet const& t) {
  Vec3 const a = t[1] - t[0], b = t[2] - t[0], c = t[3] - t[0];
  Vec3 const f1 = 0.5 * cross(c, b), f2 = 0.5 * cross(a, c), f3 = 0.5 * cross(b, a);
  return {-(f1 + f2 + f3), f1, f2, f3};
}

std::array<double, 4> altitudes(Tet const& t) {
  auto const areas = face_area_vectors(t);
  double const v = volume(t);
  std::array<double, 4> h{};
  for (int k = 0; k < 4; ++k) {
    double const a = norm(areas[k]);
    h[k] = a > 0 ? 3 * v / a : 0;
  }
  return h;
}

double smallest_altitude(Tet const& t) {
  auto const h = altitudes(t);
  return *std::min_element(h.begin(), h.end());
}

double longest_edge(Tet const& t) {
  double longest = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) longest = std::max(longest, norm(t[j] - t[i]));
  return longest;
}

std::array<double, 6> dihedral_angles(Tet const& t) {
  // The two faces that meet at edge ij are those opposite to the other two corners.
  static constexpr std::array<std::array<int, 2>, 6> faces{{{2, 3}, {1, 3}, {1, 2}, {0, 3}, {0, 2}, {0, 1}}};
  auto const n = face_area_vectors(t);
  std::array<double, 6> angle{};
  for (int e = 0; e < 6; ++e) {
    Vec3 const a = n[faces[e][0]], b = n[faces[e][1]];
    angle[e] =
        std::numbers::pi - std::atan2(norm(cross(a, b)), dot(a, b)); // exact also for flat tets, unlike acos
  }
  return angle;
}

double smallest_dihedral_angle(Tet const& t) {
  auto const a = dihedral_angles(t);
  return *std::min_element(a.begin(), a.end());
}

double mean_ratio(Tet const& t) {
  double const v = volume(t);
  if (!(v > 0)) return 0;
  double squares = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) squares += dot(t[j] - t[i], t[j] - t[i]);
  double const root = std::cbrt(3 * v);
  return 12 * root * root / squares;
}

double regular_edge(double volume) {
  return std::cbrt(6 * std::numbers::sqrt2 * volume);
}

std::array<double, 4> barycentric(Tet const& t, Vec3 p) {
  Vec3 const l = inverse_edge_matrix(t) * (p - t[0]);
  return {1 - l.x - l.y - l.z, l.x, l.y, l.z};
}

} // namespace fissura::geometry
