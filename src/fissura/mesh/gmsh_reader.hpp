#pragma once
// Meshes from gmsh: .msh files and .geo geometries.
#include <filesystem>

#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// Reads a .msh file (format 2.2 or 4.1, text or binary) or meshes a .geo file in three dimensions with the
/// gmsh library. A .geo gives the mesh that gmsh would save: scaled by Mesh.ScalingFactor, without volumes in
/// no physical group (unless there is no group or Mesh.SaveAll is set; Mesh::doubts says so). Physical
/// volumes, surfaces, curves and points become groups (an unnamed physical N is called "N"; tets in no
/// physical volume are in group "default"); input_id holds gmsh's element numbers. Tets of negative
/// orientation are turned round, which is usual for gmsh. Call check_mesh on the result.
/// @param length_unit metres per length unit of the file
/// @param element_size [m], uniform element size of a .geo mesh; 0 = as the file says; without effect on a
/// .msh Throws core::InputError at the file when it cannot be read or meshed, when it has 3-D elements other
/// than 4-node tets, and when physical volumes overlap. A .geo that ends or starts programs (Exit,
/// SystemCall) is refused.
Mesh read_gmsh(std::filesystem::path const& path, double length_unit, double element_size);

} // namespace fissura::mesh
