#pragma once
// Measures of a triangle and places in it: pure functions of its three corners.
#include <array>

#include "fissura/core/vec3.hpp"

namespace fissura::geometry {

using Triangle = std::array<Vec3, 3>;

/// Normal (right-hand turn of the corners) whose length is the area [m2].
inline Vec3 area_vector(Triangle const& t) {
  return 0.5 * core::cross(t[1] - t[0], t[2] - t[0]);
}
/// Area [m2].
inline double area(Triangle const& t) {
  return core::norm(area_vector(t));
}
/// Unit normal; the zero vector where the corners lie on one line.
inline Vec3 normal(Triangle const& t) {
  return core::unit(area_vector(t));
}
inline Vec3 centroid(Triangle const& t) {
  return (t[0] + t[1] + t[2]) / 3;
}
/// Length of the longest edge [m].
double longest_edge(Triangle const& t);

/// Barycentric coordinates of the projection of p onto the plane of t; they sum to 1 and are not clamped: all
/// are in [0, 1] where the projection lies in the triangle. Undefined (not finite) for a triangle without
/// area.
std::array<double, 3> barycentric(Triangle const& t, Vec3 p);

/// Area [m2] that two triangles of (nearly) one plane have in common, seen along the normal of a.
double overlap_area(Triangle const& a, Triangle const& b);

} // namespace fissura::geometry
