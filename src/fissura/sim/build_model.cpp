#include "fissura/sim/build_model.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <numbers>
#include <optional>

#include "fissura/contact/contact.hpp"
#include "fissura/contact/rigid.hpp"
#include "fissura/mesh/box.hpp"
#include "fissura/mesh/check.hpp"
#include "fissura/mesh/gmsh_reader.hpp"
#include "fissura/mesh/inp_reader.hpp"
#include "fissura/mesh/renumber.hpp"
#include "fissura/model/defaults.hpp"
#include "fissura/model/make_blocks.hpp"
#include "fissura/model/make_joints.hpp"
#include "fissura/model/make_points.hpp"
#include "fissura/model/presets.hpp"
#include "fissura/rebar/crack_spacing.hpp"
#include "fissura/rebar/rebar.hpp"
#include "fissura/sim/advice.hpp"
#include "fissura/sim/bar_doubts.hpp"
#include "fissura/sim/columns.hpp"
#include "fissura/sim/crack_delay.hpp"
#include "fissura/sim/doubts.hpp"
#include "fissura/sim/stages.hpp"
#include "fissura/step/joint_inertia.hpp"
#include "fissura/step/stable_step.hpp"
#include "fissura/units/units.hpp"

namespace fissura::sim {

using model::Model;

namespace {

mesh::Mesh make_mesh(model::MeshSpec const& spec) {
  if (!spec.file.empty()) {
    auto mesh = std::filesystem::path(spec.file).extension() == ".inp"
                    ? mesh::read_inp(spec.file, spec.length_unit)
                    : mesh::read_gmsh(spec.file, spec.length_unit, spec.element_size);
    if (spec.separate) mesh.tet_body = mesh::connected_bodies(mesh, mesh::make_adjacency(mesh));
    return mesh;
  }
  std::vector<mesh::BoxCells> boxes;
  for (auto const& b : spec.boxes)
    boxes.push_back({b.name, b.from, b.to, b.cells, b.tets_per_cell, b.grading, b.place, b.body});
  return mesh::make_boxes(boxes);
}

void note_assumptions(Model const& m, BuildReport& report) {
  for (auto const& c : m.source.concretes) {
    for (auto& note : model::preset_notes(c)) report.notes.push_back(std::move(note));
    if (!c.joints || !c.crackable) continue;
    if (c.G_f == 0)
      report.notes.push_back(fmt::format("{}: G_f = 73 f_cm^0.18 = {:.4g} N/m (fib MC2010, f_cm = f_c)",
                                         c.name, model::default_fracture_energy(c.f_c)));
    if (c.shear == model::ShearStrength::mohr_coulomb) {
      double const cohesion = c.cohesion > 0 ? c.cohesion : model::default_cohesion(c.f_c, c.friction_angle);
      report.notes.push_back(fmt::format("{}: Mohr-Coulomb joints, c = {:.4g} MPa, phi = {:.3g} degrees",
                                         c.name, cohesion * 1e-6, c.friction_angle * 180 / std::numbers::pi));
    }
  }
  for (auto& line : rebar::describe_slip(m.bars)) report.notes.push_back(std::move(line));
  for (int axis = 0; axis < 3; ++axis) {
    auto const worst = model::weakest_plane(m, axis);
    if (worst.stress > 0)
      report.notes.push_back(fmt::format(
          "compression along {}: the mesh's worst plane ({:.0f} degrees to the load) slides at {:.4g} MPa",
          "xyz"[axis], worst.angle * 180 / std::numbers::pi, worst.stress * 1e-6));
  }
}

/// Local damping adds at most its share alpha to the force that pulls a node back, so omega^2 grows by up to
/// 1 + alpha.
double damping_share(Model const& m) {
  double alpha = 0;
  for (auto const& s : m.stages) alpha = std::max(alpha, s.local_damping);
  return std::sqrt(1 + alpha);
}

/// Adds mass until the stable step is `dt` [s] to half a percent. Masses follow from bounds, tet by tet, so
/// the bound to ask for is found step by step, from below.
step::StableStep lift_step(Model& m, double dt) {
  auto stable = step::stable_step(m);
  for (int i = 0; i < 10 && stable.dt < 0.995 * dt; ++i) {
    model::scale_masses(m, step::mass_factors(m, stable.bound * dt / stable.dt));
    stable = step::stable_step(m);
  }
  return stable;
}

/// A step so short that the end is out of reach: names what makes it.
void check_reach(Model const& m) {
  constexpr double most_steps = 1e13; // years of the fastest machine
  double const end = planned_end(m), steps = end / m.dt;
  if (m.dt > 0 && steps < most_steps) return; // also false where one is no number
  auto const fastest = std::max_element(
      m.source.concretes.begin(), m.source.concretes.end(), [](auto const& a, auto const& b) {
        return a.E / (a.density * a.density_factor) < b.E / (b.density * b.density_factor);
      });
  auto const& run = m.source.run;
  auto const cause =
      run.dt > 0 ? fmt::format("`dt` = {} of [run]", units::from_si(run.dt, units::Dimension::time))
                 : fmt::format("`E` = {} and `density` = {} of `{}` and the smallest tets",
                               units::from_si(fastest->E, units::Dimension::pressure),
                               units::from_si(fastest->density, units::Dimension::density), fastest->name);
  throw core::InputError(
      run.dt > 0 ? core::Place{m.source.deck_file} : fastest->place,
      fmt::format(
          "the time step would be {:.3g} s, by {}: the run would need {:.3g} steps to {} and never end; are "
          "these units right, and that of `end_time`?",
          m.dt, cause, steps, units::from_si(end, units::Dimension::time)));
}

/// Joint inertia is for loading that the body follows; what it cannot do is refused, what it does badly is
/// said.
void check_joint_inertia(model::Case const& c, BuildReport& report) {
  if (!c.absorbing.empty())
    throw core::InputError(
        c.absorbing.front().place,
        "absorbing boundaries take waves away, and `joint_inertia` of [run] is for slow loading "
        "only: leave one of them out");
  if (c.run.least_dt > 0)
    throw core::InputError(
        {c.deck_file},
        "`least_dt` and `joint_inertia` of [run] both lengthen the step: leave `least_dt` out");
  if (model::has_local_damping(c))
    throw core::InputError(
        {c.deck_file},
        "`local_damping` and `joint_inertia` of [run] do not go together: damp by `mass_damping`, or leave "
        "`joint_inertia` out");
  if (model::is_fast(c))
    report.warnings.push_back(
        "`joint_inertia` of [run] delays cracks that open within some crossings of an element "
        "by a wave, and softens contact: not for impact, spalling and waves");
}

/// Whether joints get inertia; then the points are made. A load that is too fast for it is said, and where
/// the choice is the program's it decides.
std::optional<step::TiedBody> give_inertia(Model& m, BuildReport& report) {
  constexpr double too_late = 0.15, worth_a_word = 0.05; // of f_t
  if (!model::may_have_joint_inertia(m.source)) return std::nullopt;
  check_joint_inertia(m.source, report);
  model::make_points(m);
  auto const tied = step::tied_body(m);
  auto const delay = crack_delay(m, tied.rate);
  auto const late =
      fmt::format("cracks come late by up to some {:.0f} % of f_t, which loads bring in {:.2g} ms",
                  100 * delay.share, 1e3 * delay.rise);
  if (delay.share <= too_late) {
    report.notes.push_back("joint inertia: on" + (delay.share > worth_a_word ? "; " + late : ""));
    return tied;
  }
  if (m.source.run.joint_inertia == model::JointInertia::on) {
    report.warnings.push_back("with joint inertia " + late +
                              ": load more slowly, or leave `joint_inertia` of [run] out");
    return tied;
  }
  report.notes.push_back("joint inertia: off, for with it " + late + " (slower loads take longer steps)");
  m.points = {};
  return std::nullopt;
}

void choose_step(Model& m, BuildReport& report) {
  auto const& run = m.source.run;
  double const share = damping_share(m);
  auto const tied = give_inertia(m, report);
  auto const stable = tied               ? step::choose_inertia(m, *tied)
                      : run.least_dt > 0 ? lift_step(m, share * run.least_dt / run.dt_factor)
                                         : step::stable_step(m);
  double const limit = stable.dt / share;
  // A tet alone meets no joint that opens and closes, and needs no more room than its bound leaves.
  constexpr double share_of_loose = 0.95;
  m.dt = run.dt > 0 ? run.dt : std::min(run.dt_factor * limit, share_of_loose * stable.of_loose_tets / share);
  m.dt_limiter = run.dt > 0
                     ? fmt::format("given in the deck; stable step {:.4g} s by {}", limit, stable.limiter)
                     : stable.limiter;
  if (run.energy_every == 0) m.source.run.energy_every = tied ? 10 : 50;
  check_reach(m);
  if (run.dt > limit)
    report.warnings.push_back(
        fmt::format("[run] dt = {} is longer than the largest stable step, {} by {}: the run will blow up; "
                    "leave `dt` out, or give less",
                    units::from_si(run.dt, units::Dimension::time),
                    units::from_si(limit, units::Dimension::time), stable.limiter));
}

} // namespace

Model build_model(model::Case const& c, BuildReport& report, std::function<void()> const& between) {
  auto const pause = [&] {
    if (between) between();
  };
  Model m;
  m.source = c;
  pause();
  m.mesh = make_mesh(c.mesh);
  pause();
  mesh::check_mesh(m.mesh, c.mesh.place);
  mesh::renumber(m.mesh);
  pause();
  m.adjacency = mesh::make_adjacency(m.mesh);
  report.quality = mesh::measure_quality(m.mesh, m.adjacency);
  report.notes = c.notes, report.warnings = c.warnings;
  for (auto const& note : m.mesh.notes) report.notes.push_back(note);
  for (auto const& doubt : m.mesh.doubts) report.warnings.push_back(doubt);
  for (auto& warning : mesh::quality_warnings(report.quality)) report.warnings.push_back(std::move(warning));
  m.material_of_tet = model::assign_materials(c, m.mesh);
  model::make_blocks(m);
  pause();

  auto embedded = rebar::embed_bars(m.mesh, m.adjacency, c.bars, c.steels, m.joint_of_shared_face);
  m.bars = std::move(embedded.bars);
  report.embedding = std::move(embedded.report);
  report.warnings.insert(report.warnings.end(), embedded.warnings.begin(), embedded.warnings.end());
  check_bar_sizes(m, report.quality);
  std::vector<double> steel(4 * static_cast<std::size_t>(m.tets.count), 0);
  rebar::add_steel_mass(m.bars, steel);
  model::add_steel_mass(m, steel);

  rebar::set_bar_joint_laws(m);

  build_loads(m, report);
  check_gauge_names(m);
  build_rigid(m);
  contact::check_rigid_start(m);
  for (auto& warning : contact::rigid_warnings(m)) report.warnings.push_back(std::move(warning));
  if (auto warning = contact::check_start(m); !warning.empty()) report.warnings.push_back(std::move(warning));
  pause();
  choose_step(m, report);
  pause();
  build_absorbing(m); // after mass scaling
  for (auto& warning : advice(m, report.quality)) report.warnings.push_back(std::move(warning));
  for (auto& doubt : doubts(m, report.quality)) report.warnings.push_back(std::move(doubt));
  note_assumptions(m, report);
  return m;
}

} // namespace fissura::sim
