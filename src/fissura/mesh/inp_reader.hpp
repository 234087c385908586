#pragma once
// Meshes from Abaqus and CalculiX input files (.inp).
#include <filesystem>
#include <string>
#include <string_view>

#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// Reads nodes, elements, sets and surfaces of a .inp file, flat or in parts, instances and an assembly.
/// Materials, steps and loads are left alone: Mesh::notes names what is not read, Mesh::doubts what may be
/// missed.
///
/// C3D4 elements become tets, T3D2 and B31 elements lines, three-node shells and membranes triangles,
/// whatever letters follow; elements that are no body are left out. Names keep the spelling of the file
/// (inp_names.hpp says how scopes make them longer). Element sets of lines become line groups, those of
/// triangles and element-based *SURFACEs face groups, node sets and node-based surfaces point groups. A tet
/// has one volume group (inp_volumes.hpp); other sets of tets are names of the groups that make them up, or
/// Mesh::tet_sets. input_id holds the element numbers of the file; those of a later instance are counted on.
/// Call check_mesh on the result.
/// @param length_unit metres per length unit of the file
/// Throws core::InputError at the line of the file for what cannot be read: other solid elements, *INCLUDE,
/// generated nodes, tets in several volume groups, numbers that do not exist.
Mesh read_inp(std::filesystem::path const& path, double length_unit);

/// The same of a text in memory; `file` stands in messages.
/// @param copies_allowed how many nodes, elements and members of sets instances may add
Mesh parse_inp(std::string_view text, std::string const& file, double length_unit,
               std::size_t copies_allowed = 50'000'000);

} // namespace fissura::mesh
