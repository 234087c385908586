#pragma once
// Boundary faces that lie on each other although they are not shared.
#include <vector>

#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// Two boundary faces in one plane with a common area.
struct FaceOverlap {
  TetFace a, b;
  double area = 0; ///< common area [m2]
  Vec3 place;      ///< centroid of the smaller face
  bool coincident =
      false; ///< the same triangle seen from its two sides, with separate points: an open interface
};

/// All pairs of boundary faces that overlap by more than a hundredth of the smaller one. Faces closer than
/// 1e-4 of the smaller one's longest edge count as lying in one plane. Sorted by (a, b).
std::vector<FaceOverlap> find_overlaps(Mesh const& mesh, Adjacency const& adjacency);

} // namespace fissura::mesh
