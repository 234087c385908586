#pragma once
// What a name in the case stands for among the groups of the mesh.
//
// Names are looked up dimension by dimension. A kind before the name says which dimension is meant:
// "volume:1", "surface:1", "curve:1", "point:1".
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "fissura/core/error.hpp"
#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// The words for the dimensions 0 ... 3.
inline constexpr std::array<std::string_view, 4> kinds_of_groups{"point", "curve", "surface", "volume"};

/// Indices of the groups of one dimension that make up `name`, ascending; none where it has no such groups.
/// Throws core::InputError at `place` where the name stands for several things, with the names that tell them
/// apart.
std::vector<int> groups_named(Mesh const& mesh, int dimension, std::string const& name,
                              core::Place const& place);

/// The tets of volume groups or of a set of that name, ascending; none where there is none. Throws as
/// groups_named.
std::vector<int> tets_named(Mesh const& mesh, std::string const& name, core::Place const& place);

/// All names that groups of a dimension have, for a message; those that mean several things are left out.
std::vector<std::string> names_of_groups(Mesh const& mesh, int dimension);

/// The segments of all curve groups of a name, as one group. Throws as groups_named.
LineGroup curve_named(Mesh const& mesh, std::string const& name, core::Place const& place);

} // namespace fissura::mesh
