#pragma once
// A mesh from what an .inp file says.
#include "fissura/mesh/inp_contents.hpp"
#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh::inp {

/// Looks up every number, sorts by number, and makes the groups (see read_inp).
Mesh make_mesh(Contents contents);

} // namespace fissura::mesh::inp
