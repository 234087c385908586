#pragma once
// Where a straight segment runs through a tet or a triangle.
#include <array>
#include <optional>

#include "fissura/geometry/tet.hpp"
#include "fissura/geometry/triangle.hpp"

namespace fissura::geometry {

/// The part a + s (b - a), begin <= s <= end, of a segment inside a tet. enter_face and exit_face are the
/// faces (numbered by the opposite corner) it is cut at; -1 where it is the segment's own end.
struct TetPassage {
  double begin = 0, end = 1;
  int enter_face = -1, exit_face = -1;
};

/// The part of the segment ab inside the closed tet t; nothing where they do not meet. A segment that only
/// touches the tet gives begin = end.
std::optional<TetPassage> clip_to_tet(Tet const& t, Vec3 a, Vec3 b);

/// A crossing a + s (b - a), 0 <= s <= 1, of a segment through the plane of a triangle, inside the closed
/// triangle.
struct TriangleCrossing {
  double s = 0;
  std::array<double, 3> barycentric{};
};

/// Nothing where the segment misses the triangle or runs parallel to it.
std::optional<TriangleCrossing> cross_triangle(Triangle const& t, Vec3 a, Vec3 b);

/// Distance [m] of p from the segment ab (a may equal b).
double distance_to_segment(Vec3 p, Vec3 a, Vec3 b);

} // namespace fissura::geometry
