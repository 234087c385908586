#include <gtest/gtest.h>

#include "fissura/loads/loads.hpp"
#include "support/concrete_model.hpp"

namespace fissura::loads {
namespace {

using support::concrete_model;
using support::concrete_state;

/// One cell whose nodes move as the tests say.
struct Cell {
  model::Model m = concrete_model(support::box_mesh({1, 1, 1}, {0.1, 0.1, 0.1}));
  state::State s;
  state::Scratch w;
  Cell() {
    m.dt = 1e-6;
    m.overlay_tets = {0, 2};
    s = concrete_state(m);
    w.overlay = state::Overlay(m.tets.blocks() * model::block, m.overlay_tets);
  }
  void prescribe(std::string name, int axis, model::Curve curve, bool is_velocity, std::vector<int> nodes) {
    m.prescribed.push_back({std::move(name), axis, is_velocity, {std::move(curve), -1}, std::move(nodes)});
    s.reaction.push_back(0);
    s.prescribed_velocity.push_back(0);
    s.held.push_back(0);
  }
};

model::Curve constant(double value) {
  model::Curve c;
  c.value = value;
  return c;
}

// Requirement: applied forces act with pattern times curve, and their work is the mean force times the way.
TEST(AppliedForces, act_and_do_work) {
  Cell c;
  model::AppliedForce f;
  f.name = "pull";
  f.curve.curve.kind = model::Curve::Kind::table;
  f.curve.curve.times = {0, 1e-6};
  f.curve.curve.values = {100, 300};
  f.entries = {{0, 1, {0.25, 0, 0}}, {1, 3, {0.75, 0, 0}}};
  c.m.forces = {f};
  applied_forces(c.m, c.s, c.w);
  EXPECT_DOUBLE_EQ(c.w.overlay.at(0)[3], 25);
  EXPECT_DOUBLE_EQ(c.w.overlay.at(1)[9], 75);
  c.s.v(model::node_of(0, 1), 0) = 2;
  c.s.v(model::node_of(2, 3), 0) = 2;
  EXPECT_NEAR(applied_work(c.m, c.s), 200 * 2e-6, 1e-18);
}

// Requirement: gravity is its curve times its direction, and nothing while it is off.
TEST(Gravity, is_curve_times_direction) {
  Cell c;
  EXPECT_EQ(gravity_at(c.m, c.s, 1), Vec3{});
  c.m.gravity.on = true;
  c.m.gravity.direction = {0, 0, -1};
  c.m.gravity.curve.curve = constant(10);
  EXPECT_EQ(gravity_at(c.m, c.s, 1), (Vec3{0, 0, -10}));
}

// Requirement: a support takes back the step its nodes would have made, and its reaction is the force that
// does it.
TEST(MoveSupports, a_support_holds_its_nodes) {
  Cell c;
  c.prescribe("base", 2, {}, true, {3, 8});
  double const dt = c.m.dt, free = -4e-3;
  for (int const n : {3, 8}) c.s.v(n, 2) = free, c.s.u(n, 2) = free * dt; // as the tet pass left them
  c.s.v(5, 2) = 7;
  auto const effects = move_supports(c.m, c.s, {});
  for (int const n : {3, 8}) {
    EXPECT_EQ(c.s.v(n, 2), 0);
    EXPECT_EQ(c.s.u(n, 2), 0);
  }
  EXPECT_EQ(c.s.v(5, 2), 7);
  EXPECT_NEAR(c.s.reaction[0], (c.m.mass[3] + c.m.mass[8]) * -free / dt, 1e-9 * c.s.reaction[0]);
  EXPECT_EQ(effects.work_done, 0);
  EXPECT_EQ(effects.work_next, 0);
  EXPECT_NEAR(effects.kinetic.at_n, -0.125 * (c.m.mass[3] + c.m.mass[8]) * free * free, 1e-15);
}

// Requirement: with mass-proportional and local damping the reaction is still the force that holds the node:
// damping acts on what moves, and a node held at rest does not.
TEST(MoveSupports, damping_does_not_blur_reactions) {
  Cell c;
  c.m.stages[0].mass_damping = 5000;
  c.m.stages[0].local_damping = 0.5;
  c.prescribe("base", 0, {}, true, {0});
  double const dt = c.m.dt,
               a = 300; // held node: v = 0 before, so local damping has no sense and takes nothing
  c.s.v(0, 0) = dt * a / (1 + 0.5 * 5000 * dt);
  c.s.u(0, 0) = dt * c.s.v(0, 0);
  move_supports(c.m, c.s, {});
  EXPECT_NEAR(c.s.reaction[0], -c.m.mass[0] * a, 1e-9 * c.m.mass[0] * a);
}

// Requirement: a prescribed displacement is reached exactly at each step, and a prescribed velocity holds at
// half steps.
TEST(MoveSupports, motions_are_met) {
  Cell c;
  model::Curve ramp;
  ramp.kind = model::Curve::Kind::ramp, ramp.value = 1e-3, ramp.over = 1e-5;
  c.prescribe("push", 0, ramp, false, {0, 1});
  c.prescribe("spin", 1, constant(0.5), true, {2});
  for (int i = 0; i < 20; ++i) {
    for (int const n : {0, 1, 2}) // a free step with some velocity of its own
      for (int r = 0; r < 3; ++r) c.s.v(n, r) += 1e-3, c.s.u(n, r) += c.m.dt * c.s.v(n, r);
    move_supports(c.m, c.s, {});
    c.s.step += 1;
    c.s.time = static_cast<double>(c.s.step) * c.m.dt;
    EXPECT_NEAR(c.s.u(0, 0), value_at(c.m.prescribed[0].motion, c.s, c.s.time), 1e-15);
    EXPECT_NEAR(c.s.u(1, 0), c.s.u(0, 0), 1e-18);
    EXPECT_EQ(c.s.v(2, 1), 0.5);
    EXPECT_NEAR(c.s.u(2, 1), 0.5 * c.s.time, 1e-15);
  }
  EXPECT_NEAR(c.s.u(0, 0), 1e-3, 1e-15);
}

// Requirement: where a motion begins on moving nodes they lose their speed along it at once, once, and the
// work of that impact is what their kinetic energy falls by.
TEST(MoveSupports, a_late_start_is_an_impact) {
  Cell c;
  c.prescribe("catch", 1, constant(0), true, {2, 7});
  c.m.prescribed[0].motion.stage = 1;
  for (int const n : {2, 7}) c.s.v(n, 1) = 3, c.s.v(n, 0) = 5;
  EXPECT_EQ(take_hold(c.m, c.s), 0);
  EXPECT_EQ(c.s.v(2, 1), 3);
  c.s.stage = 1;
  EXPECT_NEAR(take_hold(c.m, c.s), -0.5 * (c.m.mass[2] + c.m.mass[7]) * 9, 1e-12);
  EXPECT_EQ(c.s.v(2, 1), 0);
  EXPECT_EQ(c.s.v(2, 0), 5);
  c.s.v(2, 1) = 3;
  EXPECT_EQ(take_hold(c.m, c.s), 0);
}

// Requirement: the work of a motion is the mean of the reactions before and after times the way, in two
// halves.
TEST(MoveSupports, work_is_reaction_times_way) {
  Cell c;
  c.prescribe("push", 0, constant(2), true, {0});
  c.s.prescribed_velocity[0] = 2;
  c.s.v(0, 0) = 2 - 1e-3;
  auto const e = move_supports(c.m, c.s, {});
  double const reaction = c.m.mass[0] * 1e-3 / c.m.dt;
  EXPECT_NEAR(c.s.reaction[0], reaction, 1e-9 * reaction);
  EXPECT_NEAR(e.work_done, 0.5 * reaction * 2 * c.m.dt, 1e-9 * e.work_done);
  EXPECT_NEAR(e.work_next, 0.5 * reaction * 2 * c.m.dt, 1e-9 * e.work_next);
}

} // namespace
} // namespace fissura::loads
