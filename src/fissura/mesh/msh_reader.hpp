#pragma once
// gmsh's mesh files, read without gmsh: a .msh is data, and bytes that make no sense end in an error.
#include <string>
#include <string_view>

#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// The mesh in a .msh file of format 2.2 or 4.1, as text or as (little-endian) bytes. Points are in the order
/// of their tags, tets in the order of their volumes, groups in that of their numbers. Every count is checked
/// against the size of the file before room is made. `file` stands in messages.
/// @param length_unit metres per length unit of the file
/// Throws core::InputError, at the line where there are lines.
Mesh parse_msh(std::string_view text, std::string const& file, double length_unit);

} // namespace fissura::mesh
