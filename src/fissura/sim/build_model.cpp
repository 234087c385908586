#include "fissura/sim/build_model.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <numbers>

#include "fissura/contact/contact.hpp"
#include "fissura/contact/rigid.hpp"
#include "fissura/mesh/box.hpp"
#include "fissura/mesh/check.hpp"
#include "fissura/mesh/gmsh_reader.hpp"
#include "fissura/mesh/inp_reader.hpp"
#include "fissura/mesh/renumber.hpp"
#include "fissura/model/make_blocks.hpp"
#include "fissura/model/make_joints.hpp"
#include "fissura/model/presets.hpp"
#include "fissura/rebar/rebar.hpp"
#include "fissura/sim/advice.hpp"
#include "fissura/sim/doubts.hpp"
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

void note_records(Model const& m, BuildReport& report) {
  auto largest = [](std::vector<double> const& values) {
    double most = 0;
    for (double const v : values) most = std::max(most, std::abs(v));
    return most;
  };
  for (auto const& p : m.prescribed) {
    auto const& c = p.motion.curve;
    if (c.slopes.empty()) continue;
    report.notes.push_back(
        fmt::format("motion `{}`: a record of {:.4g} s; largest velocity {:.4g} m/s, largest displacement "
                    "{:.4g} m; it ends with {:.3g} m/s at {:.4g} m",
                    p.name, c.times.back() - c.times.front(), largest(c.slopes), largest(c.values),
                    c.slopes.back(), c.values.back()));
  }
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

void choose_step(Model& m, BuildReport& report) {
  auto const& run = m.source.run;
  double const share = damping_share(m);
  auto const stable =
      run.least_dt > 0 ? lift_step(m, share * run.least_dt / run.dt_factor) : step::stable_step(m);
  double const limit = stable.dt / share;
  m.dt = run.dt > 0 ? run.dt : run.dt_factor * limit;
  m.dt_limiter = run.dt > 0
                     ? fmt::format("given in the deck; stable step {:.4g} s by {}", limit, stable.limiter)
                     : stable.limiter;
  if (run.dt > limit)
    report.warnings.push_back(
        fmt::format("[run] dt = {} is longer than the largest stable step, {} by {}: the run will blow up; "
                    "leave `dt` out, or give less",
                    units::from_si(run.dt, units::Dimension::time),
                    units::from_si(limit, units::Dimension::time), stable.limiter));
}

} // namespace

Model build_model(model::Case const& c, BuildReport& report) {
  Model m;
  m.source = c;
  m.mesh = make_mesh(c.mesh);
  mesh::check_mesh(m.mesh, c.mesh.place);
  mesh::renumber(m.mesh);
  m.adjacency = mesh::make_adjacency(m.mesh);
  report.quality = mesh::measure_quality(m.mesh, m.adjacency);
  report.warnings = m.mesh.doubts;
  for (auto& warning : mesh::quality_warnings(report.quality)) report.warnings.push_back(std::move(warning));
  report.notes = m.mesh.notes;
  m.material_of_tet = model::assign_materials(c, m.mesh);
  model::make_blocks(m);

  auto embedded = rebar::embed_bars(m.mesh, m.adjacency, c.bars, c.steels, m.joint_of_shared_face);
  m.bars = std::move(embedded.bars);
  report.embedding = std::move(embedded.report);
  report.warnings.insert(report.warnings.end(), embedded.warnings.begin(), embedded.warnings.end());
  std::vector<double> steel(4 * static_cast<std::size_t>(m.tets.count), 0);
  rebar::add_steel_mass(m.bars, steel);
  model::add_steel_mass(m, steel);

  rebar::set_bar_joint_laws(m);

  build_loads(m);
  build_rigid(m);
  contact::check_rigid_start(m);
  for (auto& warning : contact::rigid_warnings(m)) report.warnings.push_back(std::move(warning));
  if (auto warning = contact::check_start(m); !warning.empty()) report.warnings.push_back(std::move(warning));
  choose_step(m, report);
  build_absorbing(m); // after mass scaling
  for (auto& warning : advice(m, report.quality)) report.warnings.push_back(std::move(warning));
  for (auto& doubt : doubts(m, report.quality)) report.warnings.push_back(std::move(doubt));
  note_assumptions(m, report);
  note_records(m, report);
  return m;
}

} // namespace fissura::sim
