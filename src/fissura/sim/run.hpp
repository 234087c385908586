#pragma once
// The driver: from a case to a run folder.
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "fissura/model/case.hpp"

namespace fissura::model {
struct Model;
}
namespace fissura::state {
struct State;
}

namespace fissura::sim {

class History;

inline constexpr int most_threads = 1024;

struct RunOptions {
  std::string out;       ///< run folder; empty = "<deck name>.run" in the working folder
  std::string deck_echo; ///< the deck with every default, written as case.toml
  std::string version;
  int threads = -1;                 ///< -1 = as the deck says, 0 = all
  std::optional<double> until{};    ///< stop at this time [s]; 0: before the first step
  std::optional<double> walltime{}; ///< stop after so many seconds of wall time; 0: before the first step
  bool quiet = false;
  bool force = false;            ///< overwrite an existing run folder, if it is one
  bool report = false;           ///< write report.html, while the run goes on and at its end
  std::string restart;           ///< a checkpoint, or a run folder: go on with its newest one
  std::function<int()> signal{}; ///< the number of a signal that asks the run to stop, or 0; asked every step
};

/// Throws core::Error(Failure::input) that names the option for a number that has no meaning: not finite,
/// negative, more than most_threads. (Run does.)
void check_options(RunOptions const& options);

struct RunResult {
  std::string status; ///< complete, stopped, failed
  std::string reason;
  std::string folder;
};

/// One run, step by step: open(), step() until it returns false, finish().
class Run {
 public:
  /// Builds the model. Bad input throws core::InputError; nothing is written yet. A run folder that is there
  /// and that the run is to go on in, or to clear, is taken for this run alone until finish() or the end of
  /// the object; if another run is at work in it, core::Error(Failure::io) says so.
  Run(model::Case const& c, RunOptions const& options);
  ~Run();
  Run(Run&&) noexcept;
  Run& operator=(Run&&) noexcept;

  /// Makes the run folder, or cuts it back to the checkpoint the run goes on from (all that can be refused is
  /// looked at before anything is touched); with an empty `options.out` nothing is ever written and the
  /// history is kept in memory only.
  void open();
  /// One time step with the rows, frames and checks that are due with it. False once the run has ended:
  /// result() says how. A failed run ends with status "failed"; only input/output failures throw.
  bool step();
  /// Writes the last frame and the summary, before them a checkpoint if the run was stopped; a run that has
  /// not ended is "stopped" by it. Once is enough.
  RunResult const& finish();
  /// Replaces the curve of a load from now on (sim/change_load.hpp). No deck tells
  /// how, so a restart from then on is refused.
  void change_load(std::string const& name, std::string const& key, model::Curve const& curve);

  bool ended() const;
  RunResult const& result() const;
  model::Model const& model() const;
  state::State const& state() const;
  History const& history() const;
  /// What run.json holds, as JSON text.
  std::string summary() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Builds the model, runs it and leaves a run folder (docs/reference/outputs.md). A restart goes on in the
/// folder of its checkpoint unless `options.out` names another. Bad input throws
/// core::InputError before any folder is made; a run that fails on the way returns status "failed" with
/// everything written so far. A signal that comes before the first step returns status "stopped" and an empty
/// folder: nothing has been written.
RunResult run_case(model::Case const& c, RunOptions const& options);

} // namespace fissura::sim
