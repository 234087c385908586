#pragma once
// What a run says of itself in the log: before its first step, and after its last.
#include <string>
#include <vector>

#include "fissura/model/model.hpp"
#include "fissura/sim/build_model.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/sim/run.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

class Log;

/// Mesh, bars, notes and warnings of the model.
void log_opening(Log& log, model::Model const& m, BuildReport const& report, std::string const& version);
/// The checkpoint a run goes on from, and what is different now.
void log_restart(Log& log, state::State const& s, std::string const& checkpoint,
                 std::vector<std::string> const& changes, std::vector<std::string> const& warnings);
/// What lies ahead until `end` [s].
void log_steps_ahead(Log& log, model::Model const& m, double end, int threads);

/// How it ended after `wall` seconds, and how far it can be trusted.
void log_end(Log& log, state::State const& s, RunResult const& result, double wall);
void log_verdict(Log& log, model::Model const& m, state::State const& s, Monitor const& monitor);

} // namespace fissura::sim
