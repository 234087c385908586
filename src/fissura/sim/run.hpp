#pragma once
// The driver: from a case to a run folder.
#include <string>

#include "fissura/model/case.hpp"

namespace fissura::sim {

struct RunOptions {
  std::string out;       ///< run folder; empty = "<deck name>.run" in the working folder
  std::string deck_echo; ///< the deck with every default, written as case.toml
  std::string version;
  int threads = -1;    ///< < 0 = as the deck says, 0 = all
  double until = 0;    ///< > 0: stop at this time [s]
  double walltime = 0; ///< > 0: stop after so many seconds of wall time
  bool quiet = false;
  bool force = false; ///< overwrite an existing run folder
};

struct RunResult {
  std::string status; ///< complete, stopped, failed
  std::string reason;
  std::string folder;
};

/// Builds the model, runs it and leaves a run folder (docs/reference/outputs.md). Bad input throws
/// core::InputError before any folder is made; a run that fails on the way returns status "failed" with
/// everything written so far.
RunResult run_case(model::Case const& c, RunOptions const& options);

} // namespace fissura::sim
