#include "fissura/sim/run.hpp"

#include <filesystem>
#include <fmt/core.h>

#include "fissura/checkpoint/store.hpp"
#include "fissura/concrete/concrete.hpp"
#include "fissura/output/json.hpp"
#include "fissura/sim/change_load.hpp"
#include "fissura/sim/follow_paths.hpp"
#include "fissura/sim/run_impl.hpp"
#include "fissura/sim/run_log.hpp"
#include "fissura/sim/summary.hpp"
#include "fissura/step/advance.hpp"

namespace fissura::sim {

using model::Model;

namespace {

bool is_in_place(RunOptions const& o) {
  return !o.restart.empty() && is_same_folder(checkpoint::run_folder_of(checkpoint::find(o.restart)), o.out);
}

/// Of the run folder, if it is there already and this run may change it: before a long time is spent on
/// building a model for nothing.
RunLock lock_folder(model::Case const& c, RunOptions const& o) {
  std::error_code ec;
  if (o.out.empty() || !std::filesystem::exists(o.out, ec)) return {};
  bool const in_place = is_in_place(o);
  if (!in_place && !o.force) return {}; // open() refuses
  if (!in_place) check_may_force(o.out, c.deck_file);
  return RunLock(o.out);
}

} // namespace

Run::Impl::Impl(model::Case const& c, RunOptions const& options)
    : options_((check_options(options), options)), lock_(lock_folder(c, options_)),
      requests_(options.signal, options.walltime),
      threads_(options.threads >= 0 ? options.threads : c.run.threads), log_(options.quiet),
      m_(build_model(c, report_, [this] { requests_.check_signal(); })), s_(step::make_state(m_)),
      w_(step::make_scratch(m_, s_)), gauges_(m_), stops_(c, gauges_), monitor_(m_), guards_(m_), pace_(m_),
      stages_(m_),
      history_due_(c.output.history_every > 0 ? c.output.history_every
                                              : stages_.end() / std::max(1, c.output.history_points)),
      frame_due_(c.output.frames_every > 0 ? c.output.frames_every
                 : c.output.frames > 0     ? stages_.end() / c.output.frames
                                           : 0) {}

void Run::Impl::open() {
  identity_ = identify(m_, options_.version);
  if (!options_.restart.empty()) restore(checkpoint::find(options_.restart));
  if (!options_.out.empty()) open_folder();
  history_ = std::make_unique<History>(options_.out.empty() ? "" : options_.out + "/history.csv", m_, gauges_,
                                       std::move(old_history_));
  log_opening(log_, m_, report_, options_.version);
  if (!restored_.empty()) log_restart(log_, s_, restored_, changes_, warnings_);
  if (!lock_.doubt().empty()) log_.warning("{}", lock_.doubt());
  log_steps_ahead(log_, m_, end(), threads_.count());
}

bool Run::Impl::step() {
  if (ended_) return false;
  threads_.use(); // there may be several runs
  try {
    ended_ = reason_to_stop();
    if (!ended_) keep(), ended_ = advance();
    if (ended_ && store_) write_checkpoint(); // a run that is complete may be prolonged
  } catch (core::Error const& e) {
    if (e.failure == core::Failure::io) throw;
    if (auto const* failure = dynamic_cast<RunFailure const*>(&e)) trouble_ = failure->trouble;
    result_ = {"failed", e.what(), options_.out};
    ended_ = true;
  }
  return !ended_;
}

bool Run::Impl::reason_to_stop() {
  auto stop = [&](char const* status, std::string reason) {
    result_.status = status;
    result_.reason = std::move(reason);
    return true;
  };
  if (auto const asked = requests_.to_stop()) return stop("stopped", *asked);
  if (m_.source.run.max_steps > 0 && s_.step >= m_.source.run.max_steps)
    return stop("stopped", "max_steps reached");
  if (s_.load_time() < end()) return false;
  return end() < stages_.end() ? stop("stopped", "time of --until reached") : true;
}

/// One time step and what is due with it; true if it was the last one.
bool Run::Impl::advance() {
  double const time = s_.time, load_time = s_.load_time();
  bool const row = history_due_.at(load_time), frame = frame_due_.at(load_time) && fields_;
  bool const beat = s_.step % m_.source.run.energy_every == 0, reading = row || beat;
  if (frame) fields_->write(m_, s_), frame_due_.done(load_time);
  bool const steering = beat && !m_.paths.empty(); // never on rows: output settings change no result
  if (row || steering) gauges_.read_state(m_, s_);
  step::advance(m_, s_, w_, reading ? &energy_ : nullptr);
  if (auto trouble = guards_.after_step(m_, s_)) throw RunFailure(std::move(*trouble));
  if (!reading) {
    if (stages_.is_over(m_, s_)) change_stage(false);
    return false;
  }
  take_reading();
  if (row || steering) gauges_.read_forces(m_, s_, load_time);
  if (row) {
    history_->row(time, load_time, m_, s_, gauges_, energy_, monitor_);
    history_due_.done(load_time);
    if (auto const met = stops_.met(gauges_)) ended_by_ = {EndedBy::What::stop, *met};
  }
  if (steering)
    if (auto const reached = follow_paths(m_, s_, gauges_, log_)) ended_by_ = {EndedBy::What::path, *reached};
  if (beat && pace_.is_on()) pace_.steer(energy_.kinetic, energy_.internal(), s_);
  // Rest is looked for on a beat of its own, so that output settings change no result.
  if (beat || stages_.is_over(m_, s_)) change_stage(beat);
  if (ended_by_.what != EndedBy::What::none) return result_.reason = ended_by_.reason, true;
  show_progress();
  return false;
}

/// The balance of energies, with a word where it begins to drift.
void Run::Impl::take_reading() {
  bool const was_warned = monitor_.crossed_warning();
  if (auto trouble = monitor_.take(energy_, m_, s_)) throw RunFailure(std::move(*trouble));
  if (!was_warned && monitor_.crossed_warning())
    log_.warning("t = {:.5g} s: the energy residual passes {:.2g} %", s_.time,
                 100 * m_.source.run.residual_warn);
}

void Run::Impl::change_stage(bool beat) {
  auto const& stage = m_.stages[s_.stage];
  bool const is_quiet = beat && stage.settle > 0 && energy_.internal() > 0 &&
                        energy_.kinetic < stage.settle * energy_.internal() &&
                        monitor_.last_imbalance() < 0.05;
  if (!stages_.go_on(m_, s_, is_quiet)) return;
  gauges_.begin_stage(m_, s_);
  log_.info("t = {:.5g} s: stage `{}` begins", s_.time, m_.stages[s_.stage].name);
}

void Run::Impl::show_progress() {
  report_page_.meanwhile(progress_.elapsed(), log_);
  bool const terminal = terminal_.is_terminal && !options_.quiet;
  if (!progress_.due(terminal ? 1 : 10)) return;
  double const done = s_.load_time() / end();
  auto const joints = concrete::count_joints(m_, s_);
  auto const bars = count_bars(s_.bars);
  Standing const now{done,           s_.time,       progress_.eta(done), monitor_.residual(),
                     joints.damaged, joints.broken, bars.yielded,        bars.broken};
  if (terminal)
    fmt::print("\r\x1b[K{}", progress_bar_line(now, terminal_.width, terminal_.colour)), std::fflush(stdout);
  else
    log_.info("{}", progress_line(now));
}

void Run::Impl::finish_once() {
  if (finished_) return;
  finished_ = true;
  if (!ended_) {
    result_ = {"stopped", "ended before its time", options_.out};
    ended_ = true;
    if (store_) write_checkpoint();
  }
  finish();
}

void Run::Impl::finish() {
  if (terminal_.is_terminal && !options_.quiet) fmt::print("\r\x1b[K");
  if (fields_) fields_->write(m_, s_);
  history_->close();
  if (!options_.out.empty()) output::write_json(options_.out + "/run.json", summary());
  log_end(log_, s_, result_, progress_.elapsed());
  if (auto const kept = last_good_checkpoint(); !kept.empty())
    log_.info("the last good checkpoint is {}", kept);
  log_verdict(log_, m_, s_, monitor_);
  report_page_.at_end(log_);
  log_.close_file();
  lock_.release();
}

/// After a failure; empty if there is none.
std::string Run::Impl::last_good_checkpoint() const {
  return result_.status == "failed" && store_ ? store_->last() : "";
}

output::Json Run::Impl::summary() const {
  bool const has_frame = trouble_ && fields_ && !fields_->frames().empty();
  return sim::summary(m_, s_,
                      {.result = result_,
                       .energy = energy_,
                       .monitor = monitor_,
                       .version = options_.version,
                       .threads = threads_.count(),
                       .wall_seconds = wall_seconds(),
                       .has_pace = pace_.is_on(),
                       .trouble = trouble_ ? &*trouble_ : nullptr,
                       .checkpoint = last_good_checkpoint(),
                       .frame = has_frame ? frame_file("fields", fields_->frames().size() - 1) : ""});
}

Run::Run(model::Case const& c, RunOptions const& options) : impl_(std::make_unique<Impl>(c, options)) {}
Run::~Run() = default;
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;
void Run::open() {
  impl_->open();
}
bool Run::step() {
  return impl_->step();
}
RunResult const& Run::finish() {
  impl_->finish_once();
  return impl_->result_;
}
void Run::change_load(std::string const& name, std::string const& key, model::Curve const& curve) {
  sim::change_load(impl_->m_, impl_->s_, name, key, curve);
  note_changed_loads(impl_->identity_, impl_->m_);
}
bool Run::ended() const {
  return impl_->ended_;
}
RunResult const& Run::result() const {
  return impl_->result_;
}
Model const& Run::model() const {
  return impl_->m_;
}
state::State const& Run::state() const {
  return impl_->s_;
}
History const& Run::history() const {
  return *impl_->history_;
}
std::string Run::summary() const {
  return impl_->summary().dump(2, ' ', false, output::Json::error_handler_t::replace);
}

RunResult run_case(model::Case const& c, RunOptions const& options) {
  RunOptions o = options;
  std::string const old =
      o.restart.empty() ? "" : checkpoint::run_folder_of(o.restart = checkpoint::find(o.restart));
  if (o.out.empty())
    o.out = old.empty() ? std::filesystem::path(c.deck_file).stem().string() + ".run"
                        : std::filesystem::relative(old).string();
  if (std::filesystem::exists(o.out) && !o.force && !(!old.empty() && is_same_folder(old, o.out)))
    throw core::Error(core::Failure::io,
                      fmt::format("{} exists already; choose another --out or add --force", o.out));
  try {
    Run run(c, o);
    run.open();
    while (run.step()) {
    }
    return run.finish();
  } catch (Interrupted const& e) {
    return {"stopped", e.what(), ""};
  }
}

} // namespace fissura::sim
