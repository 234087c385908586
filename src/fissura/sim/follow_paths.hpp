#pragma once
// Loads that are steered by gauges.
#include <optional>
#include <string>

#include "fissura/model/model.hpp"
#include "fissura/sim/gauges.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

class Log;

/// Turns the paths whose gauges have reached their targets, and says so in the log. The last target of a path
/// that ends the run, once it is reached, in words.
std::optional<std::string> follow_paths(model::Model const& m, state::State& s, Gauges const& gauges,
                                        Log& log);

} // namespace fissura::sim
