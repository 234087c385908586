#pragma once
// Reinforcement that a deck may well state but that nobody can build.
#include <string>
#include <vector>

#include "fissura/mesh/quality.hpp"
#include "fissura/model/model.hpp"

namespace fissura::sim {

/// Throws core::InputError at the place of a bar that is thicker than the body around it.
void check_bar_sizes(model::Model const& m, mesh::Quality const& quality);

/// Warnings, each with its cure: bars that lie in each other (their steel counts twice), and more steel than
/// a section can hold.
std::vector<std::string> bar_doubts(model::Model const& m);

} // namespace fissura::sim
