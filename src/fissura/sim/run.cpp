#include "fissura/sim/run.hpp"

#include <filesystem>
#include <fmt/format.h>

#include "fissura/checkpoint/file.hpp"
#include "fissura/checkpoint/store.hpp"
#include "fissura/checkpoint/validate.hpp"
#include "fissura/concrete/kernels.hpp"
#include "fissura/loads/curve.hpp"
#include "fissura/loads/path.hpp"
#include "fissura/output/atomic_file.hpp"
#include "fissura/output/json.hpp"
#include "fissura/parallel/parallel.hpp"
#include "fissura/sim/build_model.hpp"
#include "fissura/sim/change_load.hpp"
#include "fissura/sim/clock.hpp"
#include "fissura/sim/fields.hpp"
#include "fissura/sim/fragments.hpp"
#include "fissura/sim/guards.hpp"
#include "fissura/sim/history.hpp"
#include "fissura/sim/identity.hpp"
#include "fissura/sim/log.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/sim/pace.hpp"
#include "fissura/sim/progress.hpp"
#include "fissura/sim/report_writer.hpp"
#include "fissura/sim/requests.hpp"
#include "fissura/sim/run_folder.hpp"
#include "fissura/sim/state_hash.hpp"
#include "fissura/sim/stops.hpp"
#include "fissura/sim/terminal.hpp"
#include "fissura/step/advance.hpp"

namespace fissura::step {
FISSURA_FIELDS(EnergyBalance, kinetic, strain, joints, bars, bar_joints, contact, impactors, fracture_I,
               fracture_II, friction, contact_friction, bond_steel, dowel, rupture, viscous, mass_damping,
               local_damping, absorbed, work_supports, work_forces, work_gravity, absolute_work, start)
} // namespace fissura::step

namespace fissura::sim {

using model::Model;

namespace {

/// A tet that owns a place in the overlay of forces. The sum of forces knows no order of these places, but
/// a tet without one keeps a zero's sign.
struct Slot {
  int tet = -1;
  using ListGrows = void;
  static auto fields(auto& self) { return std::tie(self.tet); }
};

double planned_time(Model const& m) {
  if (m.source.run.end_time > 0) return m.source.run.end_time;
  double sum = 0;
  for (auto const& s : m.stages) sum += s.duration;
  return sum;
}

} // namespace

class Run::Impl {
 public:
  Impl(model::Case const& c, RunOptions const& options)
      : options_(options), requests_(options.signal, options.walltime),
        threads_(options.threads >= 0 ? options.threads : c.run.threads), log_(make_log(options.quiet)),
        m_(build_model(c, report_)), s_(step::make_state(m_)), w_(step::make_scratch(m_, s_)), gauges_(m_),
        stops_(c, gauges_), monitor_(m_), guards_(m_), pace_(m_), end_(planned_time(m_)),
        history_due_(c.output.history_every > 0 ? c.output.history_every
                                                : end_ / std::max(1, c.output.history_points)),
        frame_due_(c.output.frames_every > 0 ? c.output.frames_every
                   : c.output.frames > 0     ? end_ / c.output.frames
                                             : 0) {}

  void open() {
    identity_ = identify(m_, options_.version);
    if (!options_.restart.empty()) restore(checkpoint::find(options_.restart));
    if (!options_.out.empty()) open_folder();
    history_ = std::make_unique<History>(options_.out.empty() ? "" : options_.out + "/history.csv", m_,
                                         gauges_, marks_.history);
    describe();
  }

  bool step() {
    if (ended_) return false;
    threads_.use(); // there may be several runs
    try {
      ended_ = reason_to_stop();
      if (!ended_)
        keep(), ended_ = advance();
      else if (store_ && result_.status == "stopped")
        write_checkpoint();
    } catch (core::Error const& e) {
      if (e.failure == core::Failure::io) throw;
      if (auto const* failure = dynamic_cast<RunFailure const*>(&e)) trouble_ = failure->trouble;
      result_ = {"failed", e.what(), options_.out};
      ended_ = true;
    }
    return !ended_;
  }

 private:
  friend class Run;

  void open_folder() {
    std::string const& out = options_.out;
    if (restored_.empty())
      make_folder(out, options_.force), store_ = std::make_unique<checkpoint::Store>(out);
    else
      open_old_folder();
    log_to_file(*log_, out + "/log.txt", restored_.empty());
    output::replace_file(out + "/case.toml", options_.deck_echo);
    fields_ = std::make_unique<FieldWriter>(out);
    if (!restored_.empty()) fields_->start_with(m_, marks_.frames);
    requests_.watch(out);
  }

  /// Goes on in the folder of the checkpoint, or in a new one with all that was there up to it.
  void open_old_folder() {
    std::string const old = checkpoint::run_folder_of(restored_);
    bool const here = is_same_folder(old, options_.out);
    if (!here) make_folder(options_.out, options_.force), copy_start(old, options_.out, marks_);
    store_ = std::make_unique<checkpoint::Store>(options_.out);
    here ? store_->cut_back_to(restored_) : store_->adopt(restored_);
    if (here) cut_back(options_.out, marks_);
  }

  /// All that a checkpoint holds beside what it belongs to; the same list for saving and loading.
  template <class Archive> void visit(Archive& archive) {
    long rows = history_due_.count(), frames = frame_due_.count();
    archive(s_, energy_, gauges_, stops_, monitor_, end_, settled_, rows, frames, wall_before_, marks_,
            slots_);
    history_due_.set_count(rows), frame_due_.set_count(frames);
  }

  void restore(std::string const& path) {
    std::string const contents = checkpoint::read_file(path);
    checkpoint::Loader load(contents, path);
    Identity saved;
    load(saved);
    warnings_ = compare(saved, identity_, load);
    m_.dt = identity_.dt = saved.dt;
    visit(load);
    load.finish();
    checkpoint::validate(m_, s_, load);
    if (!(end_ > 0 && end_ < 1e300)) load.refuse("the end of the run is no time");
    if (history_due_.count() < 0 || frame_due_.count() < 0 || marks_.history == 0)
      load.refuse("rows or frames were never counted so");
    w_ = step::make_scratch(m_, s_);
    for (auto const [tet] : slots_) {
      if (tet < 0 || tet >= m_.tet_count()) load.refuse("a force acts on no tet");
      w_.overlay.slot_for(tet);
    }
    restored_ = path, kept_step_ = s_.step;
    progress_.begin_at(s_.load_time() / end());
  }

  /// Writes a checkpoint at this step: every file is as long as it says. A state that has gone wrong never
  /// takes the place of a good one.
  void write_checkpoint() {
    if (auto trouble = guards_.look_everywhere(m_, s_)) throw RunFailure(std::move(*trouble));
    log_->flush();
    double const before = wall_before_;
    wall_before_ = wall_seconds();
    marks_ = {history_->flush(), size_of(options_.out + "/log.txt"), fields_->frames()};
    slots_.clear();
    for (int const tet : w_.overlay.tets) slots_.push_back({tet});
    std::string const path = store_->write([&](checkpoint::Saver& save) { save(identity_), visit(save); });
    wall_before_ = before;
    kept_at_ = progress_.elapsed(), kept_step_ = s_.step;
    log_->debug("t = {:.9g} s, step {}: checkpoint {}", s_.time, s_.step, path);
  }

  /// What is done between two steps for the sake of the run itself.
  void keep() {
    auto const& o = m_.source.output;
    if (store_ && is_checkpoint_due()) write_checkpoint();
    if (o.hash_every > 0 && s_.step % o.hash_every == 0)
      log_->debug("t = {:.9g} s, step {}: state {:016x}", s_.time, s_.step, state_hash(m_, s_));
  }

  bool is_checkpoint_due() {
    auto const& o = m_.source.output;
    if (requests_.for_output()) {
      fields_->write(m_, s_);
      if (frame_due_.at(s_.load_time())) frame_due_.done(s_.load_time());
      log_->info("t = {:.5g} s: a frame and a checkpoint, as the file `output_now` asks", s_.time);
      return true;
    }
    if (s_.step == kept_step_) return false;
    bool const by_steps = o.checkpoint_steps > 0 && s_.step > 0 && s_.step % o.checkpoint_steps == 0;
    return by_steps || (o.checkpoint_every > 0 && progress_.elapsed() - kept_at_ > o.checkpoint_every);
  }

  /// Of all parts of the run together.
  double wall_seconds() const { return wall_before_ + progress_.elapsed(); }
  /// When this part of the run ends at the latest [s].
  double end() const { return options_.until > 0 ? std::min(end_, options_.until) : end_; }

  void describe() {
    auto const& c = m_.source;
    log_->info("fissura {}: {}", options_.version, c.title.empty() ? "untitled case" : c.title);
    log_->info("mesh: {} tets, {} joints; mean size {:.4g} mm, smallest altitude {:.4g} mm", m_.tet_count(),
               m_.joint_count(), report_.quality.mean_h * 1e3, report_.quality.smallest_altitude * 1e3);
    if (!m_.bars.elements.empty())
      log_->info("bars: {} elements, {} joints, {:.4g} m, {:.4g} kg of steel", m_.bars.elements.size(),
                 m_.bars.joints.size(), report_.embedding.length(), report_.embedding.steel_mass());
    if (m_.added_mass > 0)
      log_->info("mass scaling adds {:.4g} kg to {:.4g} kg", m_.added_mass, m_.total_mass);
    for (auto const& note : report_.notes) log_->info("{}", note);
    for (auto const& warning : report_.warnings) log_->warn("{}", warning);
    if (!restored_.empty())
      log_->info("goes on from {} at t = {:.5g} s, step {}", restored_, s_.time, s_.step);
    for (auto const& warning : warnings_) log_->warn("{}", warning);
    log_->info("time step {:.4g} s, limited by {}; {:.0f} steps to t = {:.4g} s; {} threads, kernels {}",
               m_.dt, m_.dt_limiter, std::ceil(end() / m_.dt), end(), threads_.count(),
               concrete::kernels().name);
  }

  bool reason_to_stop() {
    auto stop = [&](char const* status, std::string reason) {
      result_.status = status;
      result_.reason = std::move(reason);
      return true;
    };
    if (auto const asked = requests_.to_stop()) return stop("stopped", *asked);
    if (m_.source.run.max_steps > 0 && s_.step >= m_.source.run.max_steps)
      return stop("stopped", "max_steps reached");
    if (s_.load_time() < end()) return false;
    return end() < end_ ? stop("stopped", "time of --until reached") : true;
  }

  /// One time step and what is due with it; true if it was the last one.
  bool advance() {
    double const time = s_.time, load_time = s_.load_time();
    bool const row = history_due_.at(load_time), frame = frame_due_.at(load_time) && fields_;
    bool const beat = s_.step % m_.source.run.energy_every == 0, reading = row || beat;
    if (frame) fields_->write(m_, s_), frame_due_.done(load_time);
    bool const steering = beat && !m_.paths.empty(); // never on rows: output settings change no result
    if (row || steering) gauges_.read_state(m_, s_);
    step::advance(m_, s_, w_, reading ? &energy_ : nullptr);
    if (auto trouble = guards_.after_step(m_, s_)) throw RunFailure(std::move(*trouble));
    if (!reading) return false;
    if (auto trouble = monitor_.take(energy_, m_, s_)) throw RunFailure(std::move(*trouble));
    if (row || steering) gauges_.read_forces(m_, s_, load_time);
    if (row) {
      history_->row(time, load_time, m_, s_, gauges_, energy_, monitor_);
      history_due_.done(load_time);
      if (auto const met = stops_.met(gauges_)) {
        result_.reason = *met;
        return true;
      }
    }
    if (steering && follow_paths()) return true;
    if (beat && pace_.is_on()) pace_.steer(energy_.kinetic, energy_.internal(), s_);
    if (beat) change_stage(); // on a beat of its own, so that output settings change no result
    show_progress();
    return false;
  }

  /// Turns the paths whose gauges have reached their targets; true once a path has reached its last one and
  /// says that this ends the run.
  bool follow_paths() {
    for (std::size_t i = 0; i < m_.paths.size(); ++i) {
      auto const& path = m_.paths[i];
      if (path.stage > s_.stage || loads::path_ended(path, s_.paths[i])) continue;
      int const reached = loads::follow_path(path, s_.paths[i], s_.load_time(), gauges_.values());
      for (int k = s_.paths[i].target - reached; k < s_.paths[i].target; ++k)
        log_->info("t = {:.5g} s: {}", s_.time, describe_target(path, k));
      if (!path.stops || !loads::path_ended(path, s_.paths[i])) continue;
      result_.reason = describe_target(path, s_.paths[i].target - 1);
      return true;
    }
    return false;
  }

  std::string describe_target(model::MotionPath const& path, int k) const {
    auto const& target = path.targets[static_cast<std::size_t>(k)];
    auto const gauge = static_cast<std::size_t>(target.gauge);
    return fmt::format("path of `{}`: target {} of {} reached, {} = {:.6g} for {:.6g}", path.name, k + 1,
                       path.targets.size(), m_.source.gauges[gauge].name, gauges_.values()[gauge],
                       target.value);
  }

  /// The next stage begins when the present one is over or has settled.
  void change_stage() {
    auto const& stage = m_.stages[s_.stage];
    double const since = s_.load_time() - s_.stage_start[s_.stage];
    bool const quiet = stage.settle > 0 && energy_.internal() > 0 &&
                       energy_.kinetic < stage.settle * energy_.internal() &&
                       monitor_.last_imbalance() < 0.05;
    settled_ = quiet && !loads_change() ? settled_ + 1 : 0;
    if (since < stage.duration && settled_ < 3) return;
    if (s_.stage + 1 >= static_cast<int>(m_.stages.size())) {
      if (settled_ >= 3) end_ = s_.load_time();
      return;
    }
    settled_ = 0;
    ++s_.stage;
    s_.stage_start[s_.stage] = s_.load_time();
    gauges_.begin_stage(m_, s_);
    end_with_the_last_stage();
    log_->info("t = {:.5g} s: stage `{}` begins", s_.time, m_.stages[s_.stage].name);
  }

  /// Whether a load is still on its way: a slow ramp is quiet, but not over; a steady velocity never ends.
  bool loads_change() const {
    auto changes = [&](model::TimedCurve const& c) {
      if (c.stage > s_.stage) return false;
      return s_.load_time() - (c.stage < 0 ? c.start : s_.stage_start[c.stage]) < loads::length_of(c.curve);
    };
    bool any = m_.gravity.on && changes(m_.gravity.curve);
    for (std::size_t i = 0; i < m_.prescribed.size(); ++i)
      any |= changes(m_.prescribed[i].motion) ||
             (m_.prescribed[i].is_velocity && s_.prescribed_velocity[i] != 0);
    for (std::size_t i = 0; i < m_.paths.size(); ++i)
      any |= m_.paths[i].stage <= s_.stage && !loads::path_ended(m_.paths[i], s_.paths[i]);
    for (auto const& f : m_.forces) any |= changes(f.curve);
    return any;
  }

  /// A stage that has settled early brings the end of the run forward, unless the deck names an end time.
  void end_with_the_last_stage() {
    if (m_.source.run.end_time > 0) return;
    double end = s_.load_time();
    for (auto i = static_cast<std::size_t>(s_.stage); i < m_.stages.size(); ++i) end += m_.stages[i].duration;
    end_ = end;
  }

  void show_progress() {
    report_page_.meanwhile(progress_.elapsed(), *log_);
    bool const terminal = terminal_.is_terminal && !options_.quiet;
    if (!progress_.due(terminal ? 1 : 10)) return;
    double const done = s_.load_time() / end();
    auto const joints = concrete::count_joints(m_, s_);
    auto const bars = count_bars(s_.bars);
    Standing const now{done,           s_.time,       progress_.eta(done), monitor_.residual(),
                       joints.damaged, joints.broken, bars.yielded,        bars.broken};
    if (terminal)
      fmt::print("\r\x1b[K{}", progress_bar_line(now, terminal_.width, terminal_.colour)),
          std::fflush(stdout);
    else
      log_->info("{}", progress_line(now));
  }

  void finish_once() {
    if (finished_) return;
    finished_ = true;
    if (!ended_) {
      result_ = {"stopped", "ended before its time", options_.out};
      ended_ = true;
      if (store_) write_checkpoint();
    }
    finish();
  }

  void finish() {
    if (terminal_.is_terminal && !options_.quiet) fmt::print("\r\x1b[K");
    if (fields_) fields_->write(m_, s_);
    history_->close();
    if (!options_.out.empty()) output::write_json(options_.out + "/run.json", summary());
    auto const& result = result_;
    auto const level = result.status == "failed" ? spdlog::level::err : spdlog::level::info;
    log_->log(level, "{}: {} (t = {:.5g} s, {} steps, {})", result.status, result.reason, s_.time, s_.step,
              readable_duration(progress_.elapsed()));
    if (result.status == "failed" && store_ && !store_->last().empty())
      log_->info("the last good checkpoint is {}", store_->last());
    double const quiet = monitor_.quiet_share(), imbalance = monitor_.imbalance();
    log_->info("energy residual {:+.3g} % of the energy put in", 100 * monitor_.residual());
    log_->info("kinetic/internal energy below 5 % in {:.0f} % of the readings (largest {:.3g}), forces out "
               "of balance by {:.2g} %: {}",
               100 * quiet, monitor_.kinetic_ratio(), 100 * imbalance,
               quiet > 0.9 && imbalance < 0.05
                   ? "quasi-static"
                   : "inertia matters (expected in dynamic cases; else load more slowly)");
    if (monitor_.crossed_warning())
      log_->warn("the energy residual passed {:.2g} %: look at the energy columns of history.csv before "
                 "trusting the run",
                 100 * m_.source.run.residual_warn);
    report_page_.at_end(*log_);
    close_log_file(*log_);
  }

  output::Json summary() const {
    auto const& result = result_;
    auto const joints = concrete::count_joints(m_, s_);
    auto const bars = count_bars(s_.bars);
    double const wall = wall_seconds();
    output::Json energy = output::Json::object();
    for (auto const& [name, value] : energy_.accounts()) energy[std::string(name)] = value;
    output::Json j = output::Json::object();
    j["status"] = result.status;
    j["reason"] = result.reason;
    j["version"] = options_.version;
    j["title"] = m_.source.title;
    j["threads"] = threads_.count();
    j["kernels"] = std::string(concrete::kernels().name);
    j["tets"] = m_.tet_count();
    j["joints"] = m_.joint_count();
    j["bar_elements"] = m_.bars.elements.size();
    j["bar_joints"] = m_.bars.joints.size();
    j["dt"] = m_.dt;
    j["steps"] = s_.step;
    j["time"] = s_.time;
    if (pace_.is_on()) j["mean_pace"] = s_.load_time() / std::max(s_.time, 1e-300);
    j["wall_seconds"] = wall;
    j["tet_steps_per_second"] = static_cast<double>(s_.step) * m_.tet_count() / std::max(wall, 1e-9);
    j["joints_damaged"] = joints.damaged;
    j["joints_cracked"] = joints.cracked;
    j["joints_broken"] = joints.broken;
    j["bar_joints_activated"] = bars.activated;
    j["bar_joints_yielded"] = bars.yielded;
    j["bars_broken"] = bars.broken;
    j["fragments"] = fragments_json(find_fragments(m_, s_));
    j["energy"] = energy;
    j["energy_residual"] = monitor_.residual();
    j["max_kinetic_ratio"] = monitor_.kinetic_ratio();
    j["quasi_static_share"] = monitor_.quiet_share();
    j["force_imbalance"] = monitor_.imbalance();
    j["state_hash"] = fmt::format("{:016x}", state_hash(m_, s_));
    j["stable_dt_limiter"] = m_.dt_limiter;
    j["added_mass"] = m_.added_mass;
    j["total_mass"] = m_.total_mass;
    if (!m_.rigid.empty()) j["rigid_bodies"] = rigid_bodies();
    if (trouble_) j["failure"] = failure_json(*trouble_);
    return j;
  }

  output::Json failure_json(Trouble const& t) const {
    output::Json j = output::Json::object();
    j["kind"] = t.kind;
    j["what"] = t.what;
    j["where"] = sim::describe(t.spot);
    j["tet"] = t.spot.tet;
    j["group"] = t.spot.group;
    if (t.spot.has_place) j["at"] = output::Json::array({t.spot.at.x, t.spot.at.y, t.spot.at.z});
    j["time"] = t.time;
    j["step"] = t.step;
    j["cause"] = t.cause;
    j["cure"] = t.cure;
    if (store_ && !store_->last().empty()) j["checkpoint"] = store_->last();
    if (fields_ && !fields_->frames().empty()) // the fields as they were
      j["frame"] = frame_file("fields", fields_->frames().size() - 1);
    return j;
  }

  /// Planes and impactors as they are at the end.
  output::Json rigid_bodies() const {
    auto const vector = [](Vec3 v) { return output::Json::array({v.x, v.y, v.z}); };
    output::Json list = output::Json::array();
    for (std::size_t i = 0; i < m_.rigid.size(); ++i) {
      auto const& b = s_.rigid.body[i];
      output::Json j = output::Json::object();
      j["name"] = m_.rigid[i].name;
      j["contact_impulse"] = vector(b.impulse);
      if (m_.rigid[i].is_impactor) {
        j["mass"] = m_.rigid[i].mass;
        j["displacement"] = vector(b.u);
        j["velocity"] = vector(b.v);
      }
      list.push_back(j);
    }
    return list;
  }

  RunOptions options_;
  Requests requests_;
  parallel::Threads threads_;
  std::shared_ptr<spdlog::logger> log_;
  BuildReport report_;
  Model m_;
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
  double end_; ///< when the stages end, as far as known [s]
  Due history_due_, frame_due_;
  ReportWriter report_page_{options_.out, options_.version, options_.report};
  std::unique_ptr<History> history_;
  std::unique_ptr<FieldWriter> fields_;
  step::EnergyBalance energy_;
  int settled_ = 0;
  RunResult result_{"complete", "end time reached", options_.out};
  bool ended_ = false, finished_ = false;

  Identity identity_;                        ///< of this deck, mesh and program
  std::unique_ptr<checkpoint::Store> store_; ///< none without a run folder
  FileMarks marks_;                          ///< at the last checkpoint
  std::vector<Slot> slots_;                  ///< at the last checkpoint
  std::string restored_;                     ///< the checkpoint this run goes on from
  std::vector<std::string> warnings_;        ///< of the restart
  double wall_before_ = 0;                   ///< wall time of earlier parts of the run [s]
  double kept_at_ = 0;                       ///< wall time of the last checkpoint since the start [s]
  long kept_step_ = -1;                      ///< its step
};

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
  Run run(c, o);
  run.open();
  while (run.step()) {
  }
  return run.finish();
}

} // namespace fissura::sim
