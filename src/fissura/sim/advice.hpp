#pragma once
// What an engineer with experience would say of the mesh: too few elements over the height of a member that
// is bent. What looks like a slip of the pen is in sim/doubts.hpp.
#include <string>
#include <vector>

#include "fissura/mesh/quality.hpp"
#include "fissura/model/model.hpp"

namespace fissura::sim {

/// Warnings about a model that is otherwise sound, each with its cure.
std::vector<std::string> advice(model::Model const& m, mesh::Quality const& quality);

} // namespace fissura::sim
