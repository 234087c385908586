#pragma once
// Turns a Selector of the deck into points, faces, tets and joints of the mesh. Each function gives its
// result in rising order and throws core::InputError at selector.place for an unknown group and for an empty
// result, with the names there are or the extent of the model as help. A name carried by groups of several
// kinds that fit is refused where they select different things; "surface:name" and its like say which is
// meant (mesh/groups.hpp).
#include <vector>

#include "fissura/mesh/mesh.hpp"
#include "fissura/model/case.hpp"

namespace fissura::model {

/// Distance [m] within which a place counts as selected when the selector names none: 1e-6 of the mesh's
/// largest extent.
double default_tolerance(mesh::Mesh const& mesh);

/// Whether x lies within the tolerance of the plane, box, line or point; always for kind all, never for kind
/// group.
/// @param fallback_tolerance [m], used where selector.tolerance is 0
bool inside(Selector const& selector, Vec3 x, double fallback_tolerance);

/// Point indices among the corners of tets. Kind point without a tolerance: the nearest point.
std::vector<int> select_points(mesh::Mesh const& mesh, Selector const& selector);

/// Boundary faces all of whose three points are selected; for a surface group exactly its triangles (an error
/// where some lie inside the body), for a volume group the outer faces of its tets. Kinds curve and point
/// group are errors.
std::vector<mesh::TetFace> select_boundary_faces(mesh::Mesh const& mesh, mesh::Adjacency const& adjacency,
                                                 Selector const& selector);

/// Tet indices by centroid; for a volume group its tets. Kind point without a tolerance: the nearest
/// centroid.
std::vector<int> select_tets(mesh::Mesh const& mesh, Selector const& selector);

/// Indices into adjacency.shared by the centroid of the face; for a volume group the faces with at least one
/// of its tets, for a surface group its triangles inside the body. Kind point without a tolerance: the
/// nearest centroid.
std::vector<int> select_shared_faces(mesh::Mesh const& mesh, mesh::Adjacency const& adjacency,
                                     Selector const& selector);

/// Whether the selector names a group of tets.
bool names_tets(mesh::Mesh const& mesh, Selector const& selector);

} // namespace fissura::model
