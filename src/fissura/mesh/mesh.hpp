#pragma once
// The tetrahedral mesh as read or generated: shared points, tets, named groups. Nothing here changes in time.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fissura/core/vec3.hpp"

namespace fissura::mesh {

/// Three of the corners 0 ... 3 of a tet, as bytes: every joint has two of them.
using FaceCorners = std::array<std::uint8_t, 3>;
/// Face f of a tet lies opposite to its corner f; its corners are listed so that the normal points out of the
/// tet.
inline constexpr std::array<FaceCorners, 4> face_corners{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// A named set of triangles on the faces of tets (a gmsh physical surface, or a side of a box).
struct FaceGroup {
  std::string name;
  std::vector<std::array<int, 3>> triangles; ///< point indices
};
/// A named polyline (a gmsh physical curve): reinforcement or a line support.
struct LineGroup {
  std::string name;
  std::vector<std::array<int, 2>> segments; ///< point indices
};
struct PointGroup {
  std::string name;
  std::vector<int> points;
};

/// A named set of tets that is no volume group: tets may be in several of them.
struct TetSet {
  std::string name;
  std::vector<int> tets; ///< ascending
};
/// One more name of groups of one dimension. They make up together what the name stands for; or it is the
/// name of each of them, and nobody can say which is meant.
struct GroupAlias {
  std::string name;
  int dimension = 0;               ///< 0 ... 3: points, curves, surfaces, volumes
  std::vector<std::string> groups; ///< by their own names
  bool is_ambiguous = false;
};

struct Mesh {
  std::vector<Vec3> points;               ///< reference positions [m]
  std::vector<std::array<int, 4>> tets;   ///< point indices, positive volume
  std::vector<int> tet_group;             ///< per tet: index into volume_groups
  std::vector<std::string> volume_groups; ///< at least one
  std::vector<int> tet_body;              ///< per tet: what is not joined to other bodies; empty: one body
  std::vector<FaceGroup> face_groups;
  std::vector<LineGroup> line_groups;
  std::vector<PointGroup> point_groups;
  std::vector<TetSet> tet_sets;
  std::vector<GroupAlias> aliases;
  std::vector<int> input_id;              ///< per tet: its number in the input, before renumbering
  std::vector<std::string> notes, doubts; ///< what the reader left out, and what of it may be missed
};

/// One side of a tet.
struct TetFace {
  int tet = -1;
  int face = -1;
};

/// Two tets that share a face. The local corners correspond: corner_a[k] and corner_b[k] are the same point,
/// and (corner_a[0], corner_a[1], corner_a[2]) turns so that the normal points from a to b. tet_a < tet_b.
struct SharedFace {
  TetFace a, b;
  FaceCorners corner_a{}, corner_b{};
};

/// Who touches whom. shared is sorted by (tet_a, face_a): a fixed order for every run.
struct Adjacency {
  std::vector<SharedFace> shared;
  std::vector<TetFace> boundary; ///< faces with one tet only, sorted by (tet, face)
  std::vector<std::array<int, 4>>
      shared_of_tet; ///< per tet and face: index into shared, or -1 on the boundary
};

/// Throws core::InputError where more than two tets share a face.
Adjacency make_adjacency(Mesh const& mesh);

/// Per tet the number of its body: tets joined through shared faces, numbered by their first tets.
std::vector<int> connected_bodies(Mesh const& mesh, Adjacency const& adjacency);

inline std::array<Vec3, 4> corners(Mesh const& m, int tet) {
  auto const& t = m.tets[tet];
  return {m.points[t[0]], m.points[t[1]], m.points[t[2]], m.points[t[3]]};
}

} // namespace fissura::mesh
