#pragma once
// Refuses meshes that cannot be computed, and says where they are broken.
#include "fissura/core/error.hpp"
#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// Throws one core::InputError with every kind of fault found, each with the number of cases and the first
/// few by tet number (numbers of the input, Mesh::input_id) and coordinates [m]: no tets, points that are not
/// numbers or do not exist, tets without volume (smallest altitude below 1e-6 of the longest edge) or
/// inverted, duplicate tets, faces of more than two tets, tets that overlap across their common face,
/// boundary faces that overlap without matching (hanging nodes, touching boxes whose cells differ), empty
/// groups, surface groups off the tets' faces. Pairs of boundary faces that coincide are allowed (an
/// interface left open on purpose): see measure_quality.
void check_mesh(Mesh const& mesh, core::Place const& place = {});

} // namespace fissura::mesh
