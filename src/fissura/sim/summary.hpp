#pragma once
// run.json: how a run ended, in numbers.
#include <string>

#include "fissura/model/model.hpp"
#include "fissura/output/json_fwd.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/sim/run.hpp"
#include "fissura/sim/trouble.hpp"
#include "fissura/state/state.hpp"
#include "fissura/step/ledger.hpp"

namespace fissura::sim {

/// What the summary tells beside model and state.
struct Outcome {
  RunResult const& result;
  step::EnergyBalance const& energy;
  Monitor const& monitor;
  std::string version;
  int threads = 1;
  double wall_seconds = 0;
  bool has_pace = false;            ///< pace control is on
  Trouble const* trouble = nullptr; ///< what ended the run, if it failed
  std::string checkpoint;           ///< the last good one after a failure; empty = none
  std::string frame;                ///< the last frame after a failure; empty = none
};

/// As run.json holds it (docs/reference/outputs.md).
output::Json summary(model::Model const& m, state::State const& s, Outcome const& outcome);

} // namespace fissura::sim
