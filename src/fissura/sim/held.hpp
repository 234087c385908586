#pragma once
// Bodies that nothing holds.
#include <string>
#include <vector>

#include "fissura/model/model.hpp"

namespace fissura::sim {

/// Warnings, each with its cure: bodies that no support, no motion, no bar and no other body holds, and those
/// that can still move or turn as a whole; the latter not where `may_move`.
std::vector<std::string> held_doubts(model::Model const& m, bool may_move);

} // namespace fissura::sim
