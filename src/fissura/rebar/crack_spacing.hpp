#pragma once
// The mean distance of the cracks that a bar makes in the concrete around it, from the mesh: cover, effective
// area of concrete, neighbouring bars (docs/theory/bond_slip.md, "The distance of cracks").
#include <string>
#include <vector>

#include "fissura/mesh/mesh.hpp"
#include "fissura/model/bars.hpp"
#include "fissura/rebar/tet_grid.hpp"

namespace fissura::rebar {

/// Fills in BarProperties::crack_spacing of all bars with the consistent reduction, where the deck does not
/// give it. Call once all elements are there.
void set_crack_spacings(mesh::Mesh const& mesh, TetGrid const& grid, model::Bars& bars);

/// Which law and which lengths the bars use, a line for all bars that have the same.
std::vector<std::string> describe_slip(model::Bars const& bars);

} // namespace fissura::rebar
