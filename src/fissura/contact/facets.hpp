#pragma once
// How far the flat faces of a mesh stand off the curved faces they were drawn for.
#include <vector>

#include "fissura/mesh/mesh.hpp"

namespace fissura::contact {

/// Largest sagitta [m] of boundary faces of the chosen tets: two faces that meet at an angle theta of less
/// than 60 degrees are taken for chords of one arc, c/2 tan(theta/4) with their width c across the common
/// edge. 0 where all is flat.
double largest_sagitta(mesh::Mesh const& mesh, mesh::Adjacency const& adjacency,
                       std::vector<char> const& chosen);

} // namespace fissura::contact
