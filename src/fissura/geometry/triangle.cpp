#include "fissura/geometry/triangle.hpp"

#include <algorithm>
#include <cmath>

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

/// A convex polygon with room for a triangle cut by three lines.
struct Polygon {
  std::array<Vec3, 6> corner;
  int corners = 0;
  void add(Vec3 p) {
    if (corners < 6) corner[corners++] = p;
  }
};

/// The part of a convex polygon on the side of the line through p where `inward` points.
Polygon cut(Polygon const& polygon, Vec3 p, Vec3 inward) {
  Polygon kept;
  for (int i = 0; i < polygon.corners; ++i) {
    Vec3 const a = polygon.corner[i], b = polygon.corner[(i + 1) % polygon.corners];
    double const da = dot(a - p, inward), db = dot(b - p, inward);
    if (da >= 0) kept.add(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.add(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

} // namespace

double overlap_area(Triangle const& a, Triangle const& b) {
  Vec3 const n = normal(a);
  Polygon part;
  for (Vec3 const p : b) part.add(p);
  for (int k = 0; k < 3; ++k) part = cut(part, a[k], cross(n, a[(k + 1) % 3] - a[k]));
  Vec3 sum;
  for (int i = 1; i + 1 < part.corners; ++i)
    sum += cross(part.corner[i] - part.corner[0], part.corner[i + 1] - part.corner[0]);
  return 0.5 * std::abs(dot(sum, n));
}

} // namespace fissura::geometry
