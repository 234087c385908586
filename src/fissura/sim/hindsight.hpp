#pragma once
// Doubts that only the end of a run can raise.
#include <string>
#include <vector>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

/// Bars yield at cracks only (docs/theory/limits.md): one sentence for each bar that carries more than its
/// yield strength where the concrete around it has not cracked.
std::vector<std::string> steel_beyond_yield(model::Model const& m, state::State const& s);

} // namespace fissura::sim
