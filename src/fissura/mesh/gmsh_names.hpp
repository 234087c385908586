#pragma once
// Groups that have a number and no name.
#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// gmsh calls the sets of an .inp file "PhysicalVolume1" where the physical volume 1 has no name. Its twins,
/// the .geo and the .msh, call it "1"; this adds the longer name, so that one case serves all three.
void add_names_of_numbers(Mesh& mesh);

} // namespace fissura::mesh
