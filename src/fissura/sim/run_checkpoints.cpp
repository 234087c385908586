// What a run keeps: its folder, and the checkpoints that it can go on from.
#include "fissura/checkpoint/file.hpp"
#include "fissura/checkpoint/validate.hpp"
#include "fissura/output/atomic_file.hpp"
#include "fissura/sim/run_impl.hpp"
#include "fissura/sim/state_hash.hpp"
#include "fissura/step/advance.hpp"

namespace fissura::step {
FISSURA_FIELDS(EnergyBalance, kinetic, strain, joints, bars, bar_joints, contact, impactors, fracture_I,
               fracture_II, friction, contact_friction, bond_steel, dowel, rupture, viscous, mass_damping,
               local_damping, absorbed, work_supports, work_forces, work_gravity, absolute_work, start)
} // namespace fissura::step

namespace fissura::sim {

void Run::Impl::open_folder() {
  std::string const& out = options_.out;
  if (restored_.empty())
    make_folder(out, options_.force), store_ = std::make_unique<checkpoint::Store>(out);
  else
    open_old_folder();
  log_.open_file(out + "/log.txt", restored_.empty());
  output::replace_file(out + "/case.toml", options_.deck_echo);
  if (!fields_) fields_ = std::make_unique<FieldWriter>(out);
  requests_.watch(out);
}

/// Goes on in the folder of the checkpoint, or in a new one with all that was there up to it.
void Run::Impl::open_old_folder() {
  std::string const old = checkpoint::run_folder_of(restored_);
  bool const here = is_same_folder(old, options_.out);
  if (!here) make_folder(options_.out, options_.force), copy_start(old, options_.out, marks_);
  store_ = std::make_unique<checkpoint::Store>(options_.out);
  here ? store_->cut_back_to(restored_) : store_->adopt(restored_);
  // The lists before the frames: wherever it is killed, no list names a frame that is gone.
  fields_ = std::make_unique<FieldWriter>(options_.out);
  fields_->start_with(m_, marks_.frames);
  if (here) cut_back(options_.out, marks_);
}

/// All that a checkpoint holds beside what it belongs to; the same list for saving and loading.
template <class Archive> void Run::Impl::visit(Archive& archive) {
  long rows = history_due_.count(), frames = frame_due_.count();
  archive(s_, energy_, gauges_, stops_, monitor_, stages_, rows, frames, wall_before_, marks_, slots_);
  history_due_.set_count(rows), frame_due_.set_count(frames);
}

void Run::Impl::restore(std::string const& path) {
  std::string const contents = checkpoint::read_file(path);
  checkpoint::Loader load(contents, path);
  Identity saved;
  load(saved);
  warnings_ = compare(saved, identity_, load);
  m_.dt = identity_.dt = saved.dt;
  visit(load);
  load.finish();
  checkpoint::validate(m_, s_, load);
  if (!(stages_.end() > 0 && stages_.end() < 1e300)) load.refuse("the end of the run is no time");
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
void Run::Impl::write_checkpoint() {
  if (auto trouble = guards_.look_everywhere(m_, s_)) throw RunFailure(std::move(*trouble));
  log_.flush();
  double const before = wall_before_;
  wall_before_ = wall_seconds();
  marks_ = {history_->flush(), size_of(options_.out + "/log.txt"), fields_->frames()};
  slots_.clear();
  for (int const tet : w_.overlay.tets) slots_.push_back({tet});
  std::string const path = store_->write([&](checkpoint::Saver& save) { save(identity_), visit(save); });
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
