#pragma once
// Meshes from Abaqus and CalculiX input files (.inp).
#include <filesystem>
#include <string>
#include <string_view>

#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// Reads nodes, elements and sets of a .inp file; materials, steps, loads and all else in it are left alone.
///
/// C3D4 elements become tets, T3D2 (and B31) elements lines, three-node shells and membranes triangles. Names
/// keep the spelling of the file. Element sets of lines become line groups, those of triangles and
/// element-based *SURFACEs face groups, node sets point groups. A tet has one volume group: the set that a
/// *SOLID SECTION names; without such, the *ELSET it is in; without such, the ELSET of its *ELEMENT line;
/// else "default". input_id holds the element numbers of the file. Call check_mesh on the result.
/// @param length_unit metres per length unit of the file
/// Throws core::InputError at the line of the file for what cannot be read: other solid elements, several
/// parts, moved instances, *INCLUDE, generated nodes, tets in several volume groups, numbers that do not
/// exist.
Mesh read_inp(std::filesystem::path const& path, double length_unit);

/// The same of a text in memory; `file` stands in messages.
Mesh parse_inp(std::string_view text, std::string const& file, double length_unit);

} // namespace fissura::mesh
