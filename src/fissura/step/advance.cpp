#include "fissura/step/advance.hpp"

#include <cmath>
#include <functional>

#include "fissura/concrete/concrete.hpp"
#include "fissura/contact/contact.hpp"
#include "fissura/contact/rigid.hpp"
#include "fissura/loads/loads.hpp"
#include "fissura/motion/points.hpp"
#include "fissura/rebar/rebar.hpp"
#include "fissura/step/start.hpp"

namespace fissura::step {

using model::Model;
using state::Scratch;
using state::State;

namespace {

/// What acted beside the tet pass.
struct Effects {
  double impact = 0; ///< work where supports and motions began [J]
  loads::AbsorbingEffects waves;
  loads::MotionEffects motion;
  contact::ImpactorEffects impactors;
};

/// Closes the accounts of u_n for a reading, then books the work over u_n -> u_(n+1).
void post_energy(Model const& m, State& s, state::TetSums const& sums, Effects const& effects,
                 EnergyBalance* reading) {
  auto const& [impact, waves, motion, impactors] = effects;
  auto& l = s.ledger;
  auto put_in = [&](double& account, double work) {
    account += work;
    l.absolute_work += std::abs(work);
  };
  l.viscous += sums.viscous;
  state::Kinetic kinetic = sums.kinetic;
  kinetic += waves.kinetic, kinetic += motion.kinetic;
  // c m v^2 by the trapezoidal rule over u_(n-1) -> u_n
  if (s.step > 0)
    l.mass_damping += loads::current_stage(m, s).mass_damping * m.dt * (l.kinetic_before + kinetic.at_n);
  l.kinetic_before = kinetic.at_n;
  l.local_damping += sums.local_damping + waves.local_damping + motion.local_damping;
  l.absorbed += waves.absorbed;
  put_in(l.work_supports, impact);
  put_in(l.work_supports, motion.work_done);
  if (reading) {
    reading->kinetic = kinetic.kept();
    reading->impactors = impactors.kinetic.kept();
    read_flows(*reading, m, s);
  }
  put_in(l.work_supports, motion.work_next);
  put_in(l.work_gravity, sums.gravity + waves.gravity + motion.gravity + impactors.gravity);
  put_in(l.work_forces, loads::applied_work(m, s));
}

/// Work of the impact with which supports and motions begin [J].
double begin_motions(Model const& m, State& s, Scratch const& w) {
  if (!loads::begins_now(m, s)) return 0;
  double const before = motion::relative_energy(m, s, w.points), work = loads::take_hold(m, s);
  return work + motion::relative_energy(m, s, w.points) - before;
}

/// With joint inertia: forces of the tets and Eq. (1) for all copies of a point, driven ones among them.
loads::MotionEffects move_points(Model const& m, State& s, Scratch& w, Vec3 gravity, Vec3 gravity_mean,
                                 bool reads_energy, state::TetSums& sums) {
  loads::next_velocities(m, s, w.driven);
  auto const forces = [&](std::size_t begin, std::size_t end) {
    return concrete::tet_forces(m, s, w, begin, end);
  };
  sums = motion::move_points(m, s, w, {gravity, gravity_mean, w.driven, reads_energy}, std::ref(forces));
  return loads::book_reactions(m, s, w.driven, w.points.reaction);
}

} // namespace

void advance(Model const& m, State& s, Scratch& w, EnergyBalance* reading) {
  s.time = static_cast<double>(s.step) * m.dt;
  double const impact = begin_motions(m, s, w); // where supports and motions begin
  Vec3 const gravity = loads::gravity_at(m, s, s.load_time());
  Vec3 const gravity_mean = 0.5 * (gravity + loads::gravity_at(m, s, s.load_time(m.dt)));

  loads::note_velocities(m, s, w);
  contact::refresh_pairs(m, s, w); // only when its skin is used up
  concrete::joint_forces(m, s, w); // F_conc,JE  Eqs. 13-19
  s.ledger.joint_inertia += motion::drop_released(m, s, w);
  rebar::bar_joint_forces(m, s, w); // F_rc,JE    Eqs. 20-27
  rebar::bar_forces(m, s, w);       // F_rc,FE    Eqs. 3-5
  w.overlay.clear();
  rebar::gather_bar_forces(m, w); //            to the corners of the host tets
  contact::pair_forces(m, s, w);  // F_inter    between bodies, fragments and faces that have parted
  contact::rigid_forces(m, s, w); //            and with planes and impactors
  loads::applied_forces(m, s, w); // F_ext
  if (reading) *reading = read_stored(m, s, &w.joints);
  // F_conc,FE  Eqs. 6-12, F_damp, Eq. 1
  state::TetSums sums;
  loads::AbsorbingEffects waves;
  loads::MotionEffects motion;
  if (m.points.any()) {
    motion = move_points(m, s, w, gravity, gravity_mean, reading != nullptr, sums);
  } else {
    sums = concrete::tet_forces_and_integrate(m, s, w, gravity, gravity_mean, reading != nullptr);
    waves = loads::absorb_waves(m, s, w, gravity_mean); // dashpots of absorbing boundaries
    motion = loads::move_supports(m, s, gravity_mean);  // prescribed motion, reactions
  }
  auto const impactors = contact::move_impactors(m, s, gravity, gravity_mean);
  post_energy(m, s, sums, {impact, waves, motion, impactors}, reading);

  s.lead += (s.pace - 1) * m.dt;
  s.pace *= s.pace_growth;
  s.step += 1;
  s.time = static_cast<double>(s.step) * m.dt;
}

State make_state(Model const& m) {
  State s;
  std::size_t const nodes = 4 * m.tets.blocks() * model::block, joints = m.joints.blocks() * model::block;
  s.u = core::NodeField(nodes);
  s.v = core::NodeField(nodes);
  s.joint_status = core::Buffer<std::uint8_t>(joints);
  s.joint_history = state::JointHistories(joints);
  if (m.joints.any_rate) s.joint_rate = core::Buffer<state::JointRate>(joints);
  s.bars = rebar::make_bar_state(m.bars);
  s.reaction.assign(m.prescribed.size(), 0);
  s.prescribed_velocity.assign(m.prescribed.size(), 0);
  s.held.assign(m.prescribed.size(), 0);
  s.paths.resize(m.paths.size());
  s.stage_start.assign(m.stages.size(), 0);
  s.rigid = contact::make_rigid_state(m);
  set_in_motion(m, s);
  s.ledger.start = read_stored(m, s).held() + kinetic_energy(m, s) +
                   motion::relative_energy(m, s, motion::make_rows(m, s));
  return s;
}

Scratch make_scratch(Model const& m, State const& s) {
  Scratch w;
  std::size_t const tets = m.tets.blocks() * model::block;
  w.joints = concrete::make_joint_slots(m, s);
  if (m.bonding.any || m.points.any()) w.corner_force = core::NodeField(4 * tets);
  w.overlay = state::Overlay(tets, m.overlay_tets);
  w.points = motion::make_rows(m, s);
  w.bars = rebar::make_bar_scratch(m, w.overlay);
  w.velocity_before.resize(m.absorbing.patches.size());
  w.tet_sums.resize(4 * m.tets.blocks() + 1);
  return w;
}

} // namespace fissura::step
