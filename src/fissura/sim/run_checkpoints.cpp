// What a run keeps: its folder, and the checkpoints that it can go on from.
#include <fmt/core.h>

#include "fissura/checkpoint/file.hpp"
#include "fissura/checkpoint/validate.hpp"
#include "fissura/output/atomic_file.hpp"
#include "fissura/sim/run_impl.hpp"
#include "fissura/sim/state_hash.hpp"
#include "fissura/step/advance.hpp"

namespace fissura::step {
FISSURA_FIELDS(EnergyBalance, kinetic, strain, joints, bars, bar_joints, contact, impactors, fracture_I,
               fracture_II, friction, contact_friction, bond_steel, dowel, rupture, viscous, mass_damping,
               local_damping, absorbed, joint_inertia, work_supports, work_forces, work_gravity,
               absolute_work, start)
} // namespace fissura::step

namespace fissura::sim {

void Run::Impl::open_folder() {
  std::string const& out = options_.out;
  if (restored_.empty()) {
    make_new_folder();
    store_ = std::make_unique<checkpoint::Store>(out);
  } else
    open_old_folder();
  log_.open_file(out + "/log.txt", restored_.empty());
  output::replace_file(out + "/case.toml", options_.deck_echo);
  if (!fields_) fields_ = std::make_unique<FieldWriter>(out);
  requests_.watch(out);
}

/// With `--force` it may be there, and is locked then.
void Run::Impl::make_new_folder() {
  make_folder(options_.out, options_.force);
  if (!lock_.holds()) lock_ = RunLock(options_.out);
}

/// Goes on in the folder of the checkpoint, or in a new one with all that was there up to it.
void Run::Impl::open_old_folder() {
  std::string const old = checkpoint::run_folder_of(restored_);
  bool const here = is_same_folder(old, options_.out);
  if (!here) make_new_folder(), copy_start(old, options_.out, marks_);
  store_ = std::make_unique<checkpoint::Store>(options_.out);
  here ? store_->cut_back_to(restored_) : store_->adopt(restored_);
  // The lists before the frames: wherever it is killed, no list names a frame that is gone.
  fields_ = std::make_unique<FieldWriter>(options_.out);
  fields_->start_with(m_, marks_.frames);
  if (here) cut_back(options_.out, marks_);
  if (!old_history_.text.empty()) output::replace_file(options_.out + "/history.csv", old_history_.text);
}

/// All that a checkpoint holds beside what it belongs to; the same list for saving and loading.
template <class Archive> void Run::Impl::visit(Archive& archive, Parts& parts) {
  archive(s_, energy_, parts.gauges, parts.stops, monitor_, stages_, parts.history_due, parts.frame_due,
          wall_before_, marks_, slots_, ended_by_);
}

/// Everything that can be refused is looked at here, and nothing is touched.
void Run::Impl::restore(std::string const& path) {
  std::string const contents = checkpoint::read_file(path);
  checkpoint::Loader load(contents, path);
  Identity saved;
  load(saved);
  warnings_ = compare(saved, identity_, load);
  changes_ = changed_keys(saved.settings, identity_.settings);
  m_.dt = identity_.dt = saved.dt;
  Parts parts;
  visit(load, parts);
  load.finish();
  checkpoint::validate(m_, s_, load);
  check_restored(load, parts);
  restored_ = path, kept_step_ = s_.step;
  go_on_with(parts, load);
  if (end() > 0) progress_.begin_at(s_.load_time() / end());
  if (!options_.out.empty()) check_can_go_on_in(options_.out);
}

/// Numbers that come from the file.
void Run::Impl::check_restored(checkpoint::Loader const& load, Parts const& parts) {
  if (!(stages_.end() > 0 && stages_.end() < 1e300)) load.refuse("the end of the run is no time");
  if (!history_due_.go_on(parts.history_due, s_.load_time()) ||
      !frame_due_.go_on(parts.frame_due, s_.load_time()) || marks_.history.bytes == 0 ||
      marks_.history.rows < 0)
    load.refuse("rows or frames were never counted so");
  for (auto const [tet] : slots_)
    if (tet < 0 || tet >= m_.tet_count()) load.refuse("a force acts on no tet");
}

/// What may be other than it was: the end, gauges, stop conditions.
void Run::Impl::go_on_with(Parts const& parts, checkpoint::Loader const& load) {
  w_ = step::make_scratch(m_, s_);
  for (auto const [tet] : slots_) w_.overlay.slot_for(tet);
  stages_.go_on_from(m_, s_);
  check_end_lies_ahead(load);
  gauges_.go_on_from(parts.gauges, m_, s_);
  auto columns = History::columns_of(m_, gauges_);
  auto is_new = gauges_.is_new();
  is_new.resize(columns.size(), false);
  old_history_ = read_old_history(checkpoint::run_folder_of(restored_) + "/history.csv", marks_.history,
                                  columns, is_new);
  if (ended_by_.what == EndedBy::What::none && parts.stops.empty() && stops_.saved().empty()) return;
  bool const same_stops = stops_.go_on_from(parts.stops, old_history_, gauges_);
  if (ended_by_.what == EndedBy::What::stop && !same_stops) ended_by_ = {};
  if (ended_by_.what == EndedBy::What::none) return;
  result_.reason = ended_by_.reason;
  ended_ = true;
}

/// A run that has come further than it is to go cannot go back. (It ends with the step that passes its end.)
void Run::Impl::check_end_lies_ahead(checkpoint::Loader const& load) const {
  double const reached = s_.load_time() - 1.5 * m_.dt * s_.pace; // the pace may have fallen since
  if (end() >= reached * (1 - 1e-12)) return;
  load.refuse(fmt::format(
      "the run is to end at {:.6g} s ({}), and has come to {:.6g} s already; go on from an older "
      "checkpoint, or run it anew",
      end(), options_.until && *options_.until <= stages_.end() ? "--until" : "the deck", s_.load_time()));
}

/// Writes a checkpoint at this step: every file is as long as it says. A state that has gone wrong never
/// takes the place of a good one.
void Run::Impl::write_checkpoint() {
  if (auto trouble = guards_.look_everywhere(m_, s_)) throw RunFailure(std::move(*trouble));
  log_.flush();
  double const before = wall_before_;
  wall_before_ = wall_seconds();
  marks_ = {history_->flush(), size_of(options_.out + "/log.txt"), fields_->frames()};
  slots_.clear();
  for (int const tet : w_.overlay.tets) slots_.push_back({tet});
  Parts parts{gauges_.saved(), stops_.saved(), history_due_, frame_due_};
  std::string const path =
      store_->write([&](checkpoint::Saver& save) { save(identity_), visit(save, parts); });
  wall_before_ = before;
  kept_at_ = progress_.elapsed(), kept_step_ = s_.step;
  log_.debug("t = {:.9g} s, step {}: checkpoint {}", s_.time, s_.step, path);
}

/// What is done between two steps for the sake of the run itself.
void Run::Impl::keep() {
  auto const& o = m_.source.output;
  if (store_ && is_checkpoint_due()) write_checkpoint();
  if (o.hash_every > 0 && s_.step % o.hash_every == 0)
    log_.debug("t = {:.9g} s, step {}: state {:016x}", s_.time, s_.step, state_hash(m_, s_));
}

bool Run::Impl::is_checkpoint_due() {
  auto const& o = m_.source.output;
  if (requests_.for_output()) {
    fields_->write(m_, s_);
    if (frame_due_.at(s_.load_time())) frame_due_.done(s_.load_time());
    log_.info("t = {:.5g} s: a frame and a checkpoint, as the file `output_now` asks", s_.time);
    return true;
  }
  if (s_.step == kept_step_) return false;
  bool const by_steps = o.checkpoint_steps > 0 && s_.step > 0 && s_.step % o.checkpoint_steps == 0;
  return by_steps || (o.checkpoint_every > 0 && progress_.elapsed() - kept_at_ > o.checkpoint_every);
}

} // namespace fissura::sim
