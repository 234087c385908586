#include <gtest/gtest.h>

#include "fissura/concrete/concrete.hpp"
#include "fissura/rebar/rebar.hpp"
#include "fissura/sim/build_model.hpp"
#include "fissura/sim/check.hpp"
#include "fissura/sim/crack_delay.hpp"
#include "fissura/sim/fields.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/sim/template_case.hpp"
#include "fissura/step/stable_step.hpp"
#include "support/cases.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::support {
namespace {

/// A bonded block and a jointed block that share a side.
model::Case half_bonded() {
  auto c = box_case({2, 2, 2}, {0.2, 0.2, 0.2}, 1);
  c.mesh.boxes = {box_of_cells("solid", {}, {0.2, 0.2, 0.2}, {2, 2, 2}),
                  box_of_cells("cracking", {0.2, 0, 0}, {0.4, 0.2, 0.2}, {2, 2, 2})};
  c.concretes.push_back(c.concretes[0]);
  c.concretes[0].name = "solid", c.concretes[0].groups = {"solid"}, c.concretes[0].joints = false;
  c.concretes[1].name = "cracking", c.concretes[1].groups = {"cracking"};
  return c;
}

// Requirement: tets of a bonded material share their nodes, those of a jointed one own theirs, and the side
// between both has joints.
TEST(MixedMaterials, are_joined_where_they_meet) {
  Stepper x(half_bonded());
  int inside_solid = 0, between = 0, inside_cracking = 0;
  for (std::size_t f = 0; f < x.m.adjacency.shared.size(); ++f) {
    auto const& face = x.m.adjacency.shared[f];
    int const cracking = x.m.material_of_tet[face.a.tet] + x.m.material_of_tet[face.b.tet];
    bool const joined = x.m.joint_of_shared_face[f] >= 0;
    EXPECT_EQ(joined, cracking > 0);
    (cracking == 0 ? inside_solid : cracking == 1 ? between : inside_cracking) += 1;
  }
  EXPECT_EQ(between, 8);
  EXPECT_EQ(x.m.joint_count(), between + inside_cracking);
  EXPECT_GT(inside_solid, 0);
  for (std::size_t c = 0; c + 1 < x.m.bonding.start.size(); ++c)
    for (int i = x.m.bonding.start[c] + 1; i < x.m.bonding.start[c + 1]; ++i)
      EXPECT_EQ(x.m.material_of_tet[x.m.bonding.node[i] / 4], 0);
}

// Requirement: in a mixed body bonded copies move as one to the bit, and elastic energy and momentum are
// kept.
TEST(MixedMaterials, move_as_one_body) {
  Stepper x(half_bonded());
  for (int n = 0; n < node_count(x.m); ++n) {
    Vec3 const X = position(x.m, n);
    set_node(x.s.v, n, {1e-3 * std::cos(3.14159265 * X.x / 0.4), 0, 0});
  }
  double const start = x.read().held();
  for (int i = 0; i < 100; ++i) {
    x.advance(19);
    EXPECT_NEAR(x.read().held(), start, 0.01 * start);
  }
  EXPECT_EQ(concrete::count_joints(x.m, x.s).damaged, 0);
  for (std::size_t c = 0; c + 1 < x.m.bonding.start.size(); ++c)
    for (int i = x.m.bonding.start[c]; i < x.m.bonding.start[c + 1]; ++i)
      EXPECT_EQ(at_node(x.s.u, x.m.bonding.node[i]), at_node(x.s.u, x.m.bonding.node[x.m.bonding.start[c]]));
}

// Requirement: the masses of nodes sum to that of concrete and steel; the report names assumed values.
TEST(BuildModel, masses_and_notes) {
  auto c = tie_case({4, 2, 2}, 1, 1);
  c.concretes[0].G_f = 0;
  c.run.joint_inertia = model::JointInertia::off;
  Stepper x(c);
  double mass = 0;
  for (double const m : x.m.mass) mass += m;
  double const steel = 7850 * 0.6 * 3.14159265358979 * 0.012 * 0.012 / 4;
  EXPECT_NEAR(mass, 2500 * 0.6 * 0.01 + steel, 1e-9 * mass);
  EXPECT_NEAR(x.m.total_mass, mass, 1e-9 * mass);
  EXPECT_NEAR(x.report.embedding.steel_mass(), steel, 1e-9 * steel);
  auto noted = [&](char const* what) {
    for (auto const& n : x.report.notes)
      if (n.find(what) != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(noted("G_f = 73 f_cm^0.18 = 134.6"));
  EXPECT_TRUE(noted("Mohr-Coulomb"));
  EXPECT_TRUE(noted("worst plane"));
}

// Requirement: joint inertia lengthens the step by itself where loading is slow; not with what it delays or
// what asks for a step of its own, nor where loads come so fast that cracks would be late, which is said.
TEST(BuildModel, lets_joints_carry_inertia_where_loading_is_slow) {
  auto const pulled = [](double speed) { return tie_case({4, 2, 2}, 1, speed); };
  auto off = pulled(1e-3);
  off.run.joint_inertia = model::JointInertia::off;
  Stepper const with(pulled(1e-3)), without(off);
  EXPECT_TRUE(with.m.points.any());
  EXPECT_FALSE(without.m.points.any());
  EXPECT_GT(with.m.dt, 3 * without.m.dt);
  auto const is_off = [&](auto const& change) {
    auto c = pulled(1e-3);
    change(c);
    return !Stepper(c).m.points.any();
  };
  EXPECT_TRUE(is_off([](model::Case& c) { c.run.dt = 1e-7; }));
  EXPECT_TRUE(is_off([](model::Case& c) { c.run.local_damping = 0.3; }));
  EXPECT_TRUE(is_off([](model::Case& c) { c.run.least_dt = 2e-7; }));
  EXPECT_TRUE(is_off([](model::Case& c) { c.absorbing = {{{}, "all", support::everything()}}; }));
  EXPECT_TRUE(is_off([](model::Case& c) { c.concretes[0].rate_factor = model::RateFactor::mc2010; }));
  auto both = pulled(1e-3);
  both.run.local_damping = 0.3, both.run.joint_inertia = model::JointInertia::on;
  EXPECT_THROW(Stepper{both}, core::InputError);

  auto fast = pulled(1);
  Stepper const judged(fast);
  EXPECT_FALSE(judged.m.points.any());
  auto const says = [](std::vector<std::string> const& list, char const* what) {
    return std::any_of(list.begin(), list.end(), [&](auto const& n) { return n.find(what) != n.npos; });
  };
  EXPECT_TRUE(says(judged.report.notes, "joint inertia: off, for with it cracks come late"));
  for (double const end : {1e-6, 100.0}) { // a run that is prolonged stays what it was
    auto prolonged = fast;
    prolonged.run.end_time = end;
    EXPECT_FALSE(Stepper(prolonged).m.points.any()) << end;
  }
  fast.run.joint_inertia = model::JointInertia::on;
  Stepper const forced(fast);
  EXPECT_TRUE(forced.m.points.any());
  EXPECT_TRUE(says(forced.report.warnings, "with joint inertia cracks come late"));
}

// Requirement: the estimate of the delay follows its formula: ten times slower loads, 10^(2/3) times less.
TEST(BuildModel, estimates_how_late_cracks_are) {
  auto slow = tie_case({4, 2, 2}, 1, 1e-3), slower = tie_case({4, 2, 2}, 1, 1e-4);
  for (auto* c : {&slow, &slower}) c->motions[0].curve = constant(c == &slow ? 1e-3 : 1e-4);
  Stepper const a(slow), b(slower);
  auto const first = sim::crack_delay(a.m, a.m.points.rate), second = sim::crack_delay(b.m, b.m.points.rate);
  double const far = 0.5 * slow.concretes[0].f_t / slow.concretes[0].E * 0.6;
  EXPECT_NEAR(first.rise, far / 1e-3, 1e-3 * first.rise);
  EXPECT_NEAR(first.share / second.share, std::pow(10, 2.0 / 3), 0.01);
}

// Requirement: dt is dt_factor of the stable step, or as given.
TEST(BuildModel, chooses_the_step) {
  auto c = tie_case({4, 2, 2}, 1, 1);
  c.run.joint_inertia = model::JointInertia::off;
  Stepper a(c);
  EXPECT_DOUBLE_EQ(a.m.dt, 0.85 * step::stable_step(a.m).dt);
  c.run.dt_factor = 0.5;
  EXPECT_DOUBLE_EQ(Stepper(c).m.dt, a.m.dt * 0.5 / 0.85);
  c.run.dt = 1e-8;
  EXPECT_EQ(Stepper(c).m.dt, 1e-8);
  c.run.dt = 0;
  c.run.local_damping = 0.44;
  EXPECT_DOUBLE_EQ(Stepper(c).m.dt, a.m.dt * 0.5 / 0.85 / 1.2);
}

// Requirement: selective mass scaling lifts the step to the one asked for and adds mass only where it is
// needed.
TEST(BuildModel, selective_mass_scaling_lifts_the_step) {
  auto c = tie_case({4, 2, 2}, 1, 1);
  Stepper const plain(c);
  c.run.least_dt = 1.5 * plain.m.dt;
  Stepper const scaled(c);
  EXPECT_NEAR(scaled.m.dt, 1.5 * plain.m.dt, 0.02 * scaled.m.dt);
  EXPECT_GT(scaled.m.added_mass, 0);
  EXPECT_NEAR(scaled.m.total_mass, plain.m.total_mass, 1e-12 * plain.m.total_mass);
  for (int n = 0; n < node_count(plain.m); ++n) EXPECT_GE(scaled.m.mass[n], plain.m.mass[n] * (1 - 1e-12));
}

// Requirement: supports hold all copies of the points on their plane, and only those, on their axes.
TEST(BuildLoads, supports_hold_all_copies) {
  Stepper x(tie_case({4, 2, 2}, 1, 1));
  ASSERT_EQ(x.m.prescribed.size(), 4u);
  std::size_t on_plane = 0;
  for (int n = 0; n < node_count(x.m); ++n) on_plane += position(x.m, n).x < 1e-9;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(x.m.prescribed[axis].name, "left");
    EXPECT_EQ(x.m.prescribed[axis].axis, axis);
    EXPECT_EQ(x.m.prescribed[axis].nodes.size(), on_plane);
  }
  EXPECT_EQ(x.m.prescribed[3].name, "pull");
}

// Requirement: a total force keeps its size and direction however it is shared, and a pressure acts on the
// whole area.
TEST(BuildLoads, forces_keep_their_total) {
  auto c = tie_case({4, 2, 2}, 1, 1);
  model::ForceSpec f;
  f.name = "push", f.where = plane(1, 0.1), f.direction = {0, 3, 4}, f.curve = constant(100);
  model::TractionSpec p;
  p.name = "pressure", p.where = plane(1, 0.1), p.normal = true, p.curve = constant(1e4);
  model::TractionSpec t = p;
  t.name = "shear", t.normal = false, t.direction = {2, 0, 0};
  c.forces = {f}, c.tractions = {p, t};
  Stepper const x(c);
  ASSERT_EQ(x.m.forces.size(), 3u);
  auto total = [&](std::size_t i) {
    Vec3 sum;
    for (auto const& e : x.m.forces[i].entries) sum += e.share;
    return sum;
  };
  EXPECT_NEAR(norm(total(0) - Vec3{0, 0.6, 0.8}), 0, 1e-12);
  EXPECT_NEAR(norm(total(1) - Vec3{0, -0.06, 0}), 0, 1e-12);
  EXPECT_NEAR(norm(total(2) - Vec3{0.06, 0, 0}), 0, 1e-12);
}

// ---- monitor
// -----------------------------------------------------------------------------------------------------

step::EnergyBalance balance(double work, double held) {
  step::EnergyBalance e;
  e.work_supports = e.absolute_work = work;
  e.strain = held;
  return e;
}

// Requirement: the residual is the largest missing energy over the largest energy put in, signed.
TEST(Monitor, residual_is_signed_and_keeps_the_worst) {
  Stepper x(tie_case({4, 1, 1}, 1, 1));
  sim::Monitor m(x.m);
  EXPECT_EQ(m.residual(), 0);
  EXPECT_FALSE(m.take(balance(100, 100.5), x.m, x.s));
  EXPECT_NEAR(m.residual(), -0.005, 1e-12);
  EXPECT_FALSE(m.take(balance(200, 199.9), x.m, x.s));
  EXPECT_NEAR(m.residual(), -0.0025, 1e-12);
  EXPECT_FALSE(m.crossed_warning());
  EXPECT_FALSE(m.take(balance(200, 196), x.m, x.s));
  EXPECT_NEAR(m.residual(), 0.02, 1e-12);
  EXPECT_TRUE(m.crossed_warning());
  auto const reason = m.take(balance(200, 180), x.m, x.s);
  ASSERT_TRUE(reason);
  EXPECT_NE(sim::describe(*reason).find("energy was lost"), std::string::npos);
}

// Requirement: the kinetic ratio ignores the start, where both energies are tiny.
TEST(Monitor, kinetic_ratio_ignores_the_start) {
  Stepper x(tie_case({4, 1, 1}, 1, 1));
  sim::Monitor m(x.m);
  auto put = [&](double kinetic, double strain) {
    auto e = balance(kinetic + strain, strain);
    e.kinetic = kinetic;
    m.take(e, x.m, x.s);
  };
  put(1e-3, 1e-4);
  put(1, 50);
  put(2, 200);
  EXPECT_NEAR(m.kinetic_ratio(), 0.02, 1e-12);
}

// ---- fields
// ------------------------------------------------------------------------------------------------------

// Requirement: frames hold a cell per tet, per damaged joint and per bar element and joint, with arrays that
// fit.
TEST(Fields, have_the_size_of_the_model) {
  Stepper x(tie_case({4, 2, 2}, 1, 2));
  x.advance(600);
  int const damaged = concrete::count_joints(x.m, x.s).damaged;
  ASSERT_GT(damaged, 0);
  auto const tets = sim::tet_grid(x.m, x.s), cracks = sim::crack_grid(x.m, x.s),
             bars = sim::bar_grid(x.m, x.s);
  EXPECT_EQ(tets.types.size(), static_cast<std::size_t>(x.m.tet_count()));
  EXPECT_EQ(cracks.types.size(), static_cast<std::size_t>(damaged));
  EXPECT_EQ(bars.types.size(), x.m.bars.elements.size() + x.m.bars.joints.size());
  for (auto const* g : {&tets, &cracks, &bars}) EXPECT_EQ(g->connectivity.size(), g->points.size());
}

/// The cell data of this name.
std::vector<float> cells_of(output::Grid const& g, std::string const& name) {
  for (auto const& array : g.cell_data)
    if (array.name == name) return std::get<std::vector<float>>(array.values);
  ADD_FAILURE() << "no " << name;
  return std::vector<float>(g.types.size());
}

// Requirement: a bar stretched with its concrete by 1e-4 along its axis, beside what it was put in with,
// shows this strain in its elements, and the stress that E_s makes of it.
TEST(Fields, show_the_strain_of_bar_elements) {
  constexpr double held_in = 2e-4, pulled = 1e-4;
  auto c = tie_case({4, 2, 2}, 1, 2);
  for (auto& bar : c.bars) bar.initial_strain = held_in;
  Stepper x(c);
  for (int n = 0; n < node_count(x.m); ++n) set_node(x.s.u, n, {pulled * position(x.m, n).x, 0, 0});
  rebar::bar_joint_forces(x.m, x.s, x.w); // moves the bars
  rebar::bar_forces(x.m, x.s, x.w);
  auto const bars = sim::bar_grid(x.m, x.s);
  auto const strain = cells_of(bars, "strain"), stress = cells_of(bars, "stress");
  ASSERT_GT(x.m.bars.elements.size(), 0U);
  for (std::size_t i = 0; i < x.m.bars.elements.size(); ++i) {
    EXPECT_NEAR(strain[i], held_in + pulled, 1e-9);
    EXPECT_NEAR(stress[i], c.steels[0].E_s * (held_in + pulled), 1e2);
  }
}

// ---- check and templates
// -----------------------------------------------------------------------------------------

// Requirement: the forecast names size, step and cost.
TEST(Check, forecasts_the_cost) {
  auto const text = sim::check_case(tie_case({4, 1, 1}, 1e-3, 1));
  for (char const* word :
       {"tets", "joints", "time step", "steps", "wall time", "memory", "disk", "bar elements"})
    EXPECT_NE(text.find(word), std::string::npos) << word << " in\n" << text;
}

// Requirement: a template is written once and never over another case; unknown names are answered with the
// known ones.
TEST(Templates, are_written_once) {
  output::testing::TemporaryFolder const folder;
  sim::write_template("tie", folder / "new");
  EXPECT_NE(output::testing::read_bytes(folder / "new/case.toml").find("[[bar]]"), std::string::npos);
  EXPECT_THROW(sim::write_template("tie", folder / "new"), core::Error);
  try {
    sim::write_template("tie", folder / "new/case.toml/below");
    FAIL();
  } catch (core::Error const& e) {
    EXPECT_EQ(e.failure, core::Failure::io);
    EXPECT_NE(std::string(e.what()).find("cannot create the folder"), std::string::npos) << e.what();
  }
  try {
    sim::write_template("bridge", folder / "other");
    FAIL();
  } catch (core::Error const& e) {
    EXPECT_NE(std::string(e.what()).find(sim::template_names()), std::string::npos);
  }
}

// Requirement: a time step beyond the largest stable one is warned of before the run.
TEST(BuildModel, warns_of_a_step_that_cannot_be_stable) {
  auto c = box_case({2, 1, 1}, {0.2, 0.1, 0.1}, 1);
  auto warns = [&] {
    sim::BuildReport report;
    sim::build_model(c, report);
    return std::any_of(report.warnings.begin(), report.warnings.end(), [](std::string const& w) {
      return w.find("longer than the largest stable step") != std::string::npos;
    });
  };
  EXPECT_FALSE(warns());
  c.run.dt = 1e-7;
  EXPECT_FALSE(warns());
  c.run.dt = 1e-5;
  EXPECT_TRUE(warns());
}

} // namespace
} // namespace fissura::support
