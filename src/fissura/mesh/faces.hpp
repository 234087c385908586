#pragma once
// Faces by their points.
#include <array>
#include <vector>

#include "fissura/geometry/triangle.hpp"
#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// Finds the sides of tets that have given points. Holds a reference to the mesh it was made for.
class FaceFinder {
 public:
  explicit FaceFinder(Mesh const& mesh);
  /// The (at most two, in a sound mesh) sides of tets whose corners are these three points, by rising tet
  /// number.
  std::vector<TetFace> find(std::array<int, 3> const& triangle) const;

 private:
  Mesh const& mesh;
  std::vector<int> begin, tets; ///< tets at point p: tets[begin[p]] .. tets[begin[p + 1] - 1]
};

/// The three points of a side of a tet, turned so that the normal points out of the tet.
inline std::array<int, 3> face_points(Mesh const& m, TetFace f) {
  auto const& t = m.tets[f.tet];
  auto const& c = face_corners[f.face];
  return {t[c[0]], t[c[1]], t[c[2]]};
}
inline geometry::Triangle face_triangle(Mesh const& m, TetFace f) {
  auto const p = face_points(m, f);
  return {m.points[p[0]], m.points[p[1]], m.points[p[2]]};
}

/// For each point whether it is the corner of a tet (points of curves that are not embedded are not).
std::vector<char> points_of_tets(Mesh const& mesh);

} // namespace fissura::mesh
