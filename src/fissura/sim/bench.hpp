#pragma once
#include <string>

namespace fissura::sim {

struct BenchOptions {
  std::string scene = "uncracked";
  long tets = 6000;
  int threads = 1;
  long steps = 0; ///< 0 = enough for about two seconds
};

/// Times `step::advance` on a scene (sim/bench_scenes) with a run's defaults, the ledger read every 50 steps
/// and no output; returns one line with "ns per tet-step".
std::string bench(BenchOptions const& options);

} // namespace fissura::sim
