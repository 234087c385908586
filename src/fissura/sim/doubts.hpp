#pragma once
// What a case may mean, but what is far more often a slip of the pen: units, supports, loads.
#include <string>
#include <vector>

#include "fissura/mesh/quality.hpp"
#include "fissura/model/model.hpp"

namespace fissura::sim {

/// Warnings, each with its cure: values far outside what the material can have, a body far larger or smaller
/// than structures are, a body that nothing holds or nothing loads, loads that come as a jump or faster than
/// concrete bears, drag that outweighs inertia, a run that ends before the body has felt its load. Empty for
/// a sound case.
std::vector<std::string> doubts(model::Model const& m, mesh::Quality const& quality);

} // namespace fissura::sim
