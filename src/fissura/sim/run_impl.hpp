#pragma once
// The parts of a run. Time goes on in run.cpp; the run folder and checkpoints are in run_checkpoints.cpp.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fissura/checkpoint/fields.hpp"
#include "fissura/checkpoint/store.hpp"
#include "fissura/output/json_fwd.hpp"
#include "fissura/parallel/parallel.hpp"
#include "fissura/sim/build_model.hpp"
#include "fissura/sim/clock.hpp"
#include "fissura/sim/fields.hpp"
#include "fissura/sim/gauges.hpp"
#include "fissura/sim/guards.hpp"
#include "fissura/sim/history.hpp"
#include "fissura/sim/identity.hpp"
#include "fissura/sim/log.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/sim/pace.hpp"
#include "fissura/sim/progress.hpp"
#include "fissura/sim/report_writer.hpp"
#include "fissura/sim/requests.hpp"
#include "fissura/sim/run.hpp"
#include "fissura/sim/run_folder.hpp"
#include "fissura/sim/run_lock.hpp"
#include "fissura/sim/stages.hpp"
#include "fissura/sim/stops.hpp"
#include "fissura/sim/terminal.hpp"
#include "fissura/sim/trouble.hpp"

namespace fissura::sim {

/// A tet that owns a place in the overlay of forces. The sum of forces knows no order of these places, but
/// a tet without one keeps a zero's sign.
struct Slot {
  int tet = -1;
  using ListGrows = void;
  static auto fields(auto& self) { return std::tie(self.tet); }
};

/// What has ended a run, beside the time: a checkpoint remembers it.
struct EndedBy {
  enum class What : int { none, stop, path };
  What what = What::none;
  std::string reason;
  static auto fields(auto& self) { return std::tie(self.what, self.reason); }
};

class Run::Impl {
 public:
  Impl(model::Case const& c, RunOptions const& options);
  void open();
  bool step();
  void finish_once();
  output::Json summary() const;

 private:
  friend class Run;

  // Time goes on.
  bool reason_to_stop();
  bool advance();
  void take_reading();
  void change_stage(bool beat);
  void show_progress();
  void finish();
  std::string last_good_checkpoint() const;
  /// Of all parts of the run together.
  double wall_seconds() const { return wall_before_ + progress_.elapsed(); }
  /// When this part of the run ends at the latest [s].
  double end() const { return options_.until ? std::min(stages_.end(), *options_.until) : stages_.end(); }

  // What is kept.
  void open_folder();
  void make_new_folder();
  void open_old_folder();
  /// Those parts of a checkpoint that may not fit the run that goes on.
  struct Parts {
    std::vector<SavedGauge> gauges;
    std::vector<SavedStop> stops;
    Due history_due{0}, frame_due{0};
  };
  template <class Archive> void visit(Archive& archive, Parts& parts);
  void restore(std::string const& path);
  void check_restored(checkpoint::Loader const& load, Parts const& parts);
  void go_on_with(Parts const& parts, checkpoint::Loader const& load);
  void check_end_lies_ahead(checkpoint::Loader const& load) const;
  void write_checkpoint();
  void keep();
  bool is_checkpoint_due();

  RunOptions options_;
  RunLock lock_; ///< of a folder that was there before
  Requests requests_;
  parallel::Threads threads_;
  Log log_;
  BuildReport report_;
  model::Model m_;
  state::State s_;
  state::Scratch w_;
  Gauges gauges_;
  Stops stops_;
  Monitor monitor_;
  Guards guards_;
  PaceControl pace_;
  std::optional<Trouble> trouble_; ///< what ended the run, if it failed
  Progress progress_;
  Terminal terminal_ = standard_output();
  Stages stages_;
  Due history_due_, frame_due_;
  ReportWriter report_page_{options_.out, options_.version, options_.report};
  std::unique_ptr<History> history_;
  std::unique_ptr<FieldWriter> fields_;
  step::EnergyBalance energy_;
  RunResult result_{"complete", "end time reached", options_.out};
  bool ended_ = false, finished_ = false;

  Identity identity_;                        ///< of this deck, mesh and program
  std::unique_ptr<checkpoint::Store> store_; ///< none without a run folder
  FileMarks marks_;                          ///< at the last checkpoint
  std::vector<Slot> slots_;                  ///< at the last checkpoint
  std::string restored_;                     ///< the checkpoint this run goes on from
  OldHistory old_history_;                   ///< what is in the file up to it
  EndedBy ended_by_;
  std::vector<std::string> warnings_; ///< of the restart
  std::vector<std::string> changes_;  ///< of the deck since the checkpoint
  double wall_before_ = 0;            ///< wall time of earlier parts of the run [s]
  double kept_at_ = 0;                ///< wall time of the last checkpoint since the start [s]
  long kept_step_ = -1;               ///< its step
};

} // namespace fissura::sim
