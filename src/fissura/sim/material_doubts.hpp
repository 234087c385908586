#pragma once
// Properties that a material may have, but that are far more often a slip of the pen.
#include <string>
#include <vector>

#include "fissura/mesh/quality.hpp"
#include "fissura/model/model.hpp"

namespace fissura::sim {

/// Warnings: values outside what is usual, and what follows from those that contradict each other ("nothing
/// can crush").
std::vector<std::string> material_doubts(model::Model const& m, mesh::Quality const& quality);

} // namespace fissura::sim
