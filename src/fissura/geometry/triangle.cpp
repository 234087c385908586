#include "fissura/geometry/triangle.hpp"

#include <algorithm>
#include <vector>

namespace fissura::geometry {

using core::cross;
using core::dot;
using core::norm;

double longest_edge(Triangle const& t) {
  return std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
}

std::array<double, 3> barycentric(Triangle const& t, Vec3 p) {
  Vec3 const n = cross(t[1] - t[0], t[2] - t[0]);
  double const scale = 1 / dot(n, n);
  double const l1 = dot(n, cross(p - t[0], t[2] - t[0])) * scale;
  double const l2 = dot(n, cross(t[1] - t[0], p - t[0])) * scale;
  return {1 - l1 - l2, l1, l2};
}

namespace {

/// The part of a convex polygon on the side of the line through p where `inward` points.
std::vector<Vec3> cut(std::vector<Vec3> const& polygon, Vec3 p, Vec3 inward) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Vec3 const a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    double const da = dot(a - p, inward), db = dot(b - p, inward);
    if (da >= 0) kept.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

} // namespace

double overlap_area(Triangle const& a, Triangle const& b) {
  Vec3 const n = normal(a);
  std::vector<Vec3> polygon(b.begin(), b.end());
  for (int k = 0; k < 3 && !polygon.empty(); ++k)
    polygon = cut(polygon, a[k], cross(n, a[(k + 1) % 3] - a[k]));
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return 0.5 * std::abs(dot(sum, n));
}

} // namespace fissura::geometry
