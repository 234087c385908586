#pragma once
// What `fissura bench` times: models of any size, and the states they start from.
#include <string>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

struct BenchScene {
  std::string name, what;
  model::Case (*make_case)(long tets);
  void (*prepare)(model::Model const& m, state::State& s);
};

/// Throws core::Error (input) naming the scenes there are.
BenchScene const& bench_scene(std::string const& name);
/// The names, with commas.
std::string bench_scene_names();

} // namespace fissura::sim
