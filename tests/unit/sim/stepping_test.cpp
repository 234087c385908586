// A run taken step by step.
#include <gtest/gtest.h>

#include <filesystem>

#include <nlohmann/json.hpp>

#include "fissura/core/error.hpp"
#include "fissura/model/model.hpp"
#include "fissura/sim/history.hpp"
#include "fissura/sim/run.hpp"
#include "fissura/state/state.hpp"
#include "support/cases.hpp"
#include "support/refusal.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::support {
namespace {

using output::testing::TemporaryFolder;

model::Case tie() {
  auto c = tie_case({4, 1, 1}, 6e-4, 1);
  auto f = gauge("force", model::GaugeSpec::Kind::reaction);
  f.of = {"pull"};
  c.gauges = {f};
  return c;
}

// Requirement: a run stepped by hand, without a folder, ends in the same bits as one that leaves a folder,
// and keeps the same rows in memory.
TEST(Stepping, is_the_same_run) {
  TemporaryFolder const folder;
  sim::RunOptions o;
  o.quiet = true, o.threads = 1;
  sim::Run alone(tie(), o);
  alone.open();
  while (alone.step()) EXPECT_FALSE(alone.ended());
  EXPECT_TRUE(alone.ended());
  EXPECT_FALSE(alone.step()) << "nothing follows the end";
  EXPECT_EQ(alone.finish().status, "complete");

  o.out = folder / "run";
  sim::Run written(tie(), o);
  written.open();
  while (written.step()) {
  }
  written.finish();
  auto const a = nlohmann::json::parse(alone.summary()), b = nlohmann::json::parse(written.summary());
  EXPECT_EQ(a["state_hash"], b["state_hash"]);
  EXPECT_EQ(alone.state().step, written.state().step);
  EXPECT_EQ(alone.history().rows(), written.history().rows());
  EXPECT_EQ(alone.history().rows().size() % alone.history().columns().size(), 0u);
  EXPECT_EQ(alone.history().columns()[0].name, "time");
  EXPECT_EQ(alone.history().columns()[1].name, "force");
}

/// Says why a change of a load is refused.
std::string refusal(sim::Run& run, std::string const& name, std::string const& key) {
  return support::refusal(core::Failure::input, [&] { run.change_load(name, key, constant(1)); });
}

// Requirement: a motion that is changed between two steps goes on from its present velocity without a jump
// and reaches the new one; the energies still add up.
TEST(Stepping, changes_a_motion_smoothly) {
  sim::RunOptions o;
  o.quiet = true, o.threads = 1;
  auto c = tie();
  c.run.joint_inertia = model::JointInertia::off; // a step is short beside the ramp
  sim::Run run(c, o);
  run.open();
  while (run.state().time < 3e-4) ASSERT_TRUE(run.step());
  double const before = run.state().prescribed_velocity.back();
  EXPECT_NEAR(before, 1, 1e-9) << "the plateau of the ramp";
  run.change_load("pull", "velocity", ramp(-0.5, 1e-4));
  ASSERT_TRUE(run.step());
  EXPECT_NEAR(run.state().prescribed_velocity.back(), before, 1e-3);
  while (run.step()) {
  }
  EXPECT_NEAR(run.state().prescribed_velocity.back(), -0.5, 1e-12);
  auto const j = nlohmann::json::parse(run.summary());
  EXPECT_LT(std::abs(j["energy_residual"].get<double>()), 0.01);
  EXPECT_EQ(run.finish().status, "complete");
}

// Requirement: a displacement is counted from t = 0, and its ramp sets out from where the points are.
TEST(Stepping, changes_to_a_displacement) {
  sim::RunOptions o;
  o.quiet = true, o.threads = 1;
  sim::Run run(tie(), o);
  run.open();
  while (run.state().time < 3e-4) ASSERT_TRUE(run.step());
  run.change_load("pull", "displacement", ramp(1e-4, 2e-4));
  while (run.step()) {
  }
  auto const& p = run.model().prescribed.back();
  EXPECT_NEAR(run.state().u(p.nodes[0], 0), 1e-4, 1e-12);
}

// Requirement: what is no load, or not the load's own key, is refused with the cure.
TEST(Stepping, refuses_to_change_what_is_no_load) {
  sim::RunOptions o;
  o.quiet = true, o.threads = 1;
  sim::Run run(tie(), o);
  run.open();
  EXPECT_EQ(refusal(run, "push", "velocity"), "there is no load `push` to change; there are: `pull`");
  EXPECT_EQ(refusal(run, "left", "velocity"), "there is no load `left` to change; there are: `pull`");
  EXPECT_EQ(refusal(run, "pull", "force"),
            "`pull` is a motion: give `displacement` or `velocity`, not `force`");
}

// Requirement: a force takes a force and a traction a traction; each says which of the two it is.
TEST(Stepping, refuses_to_mix_forces_and_tractions) {
  auto c = tie();
  model::ForceSpec push;
  model::TractionSpec press;
  push.name = "push", push.where = plane(0, 0.6), push.direction = {0, 0, -1}, push.curve = constant(500);
  press.name = "press", press.where = plane(0, 0.6), press.direction = {0, 0, -1},
  press.curve = constant(1e3);
  c.forces = {push}, c.tractions = {press};
  sim::RunOptions o;
  o.quiet = true, o.threads = 1;
  sim::Run run(c, o);
  run.open();
  EXPECT_EQ(refusal(run, "push", "traction"), "`push` is a force: give `force`, not `traction`");
  EXPECT_EQ(refusal(run, "press", "force"), "`press` is a traction: give `traction`, not `force`");
  EXPECT_EQ(refusal(run, "push", "force"), "accepted");
}

// Requirement: a load of a later stage, a motion on a path and gravity say why they cannot be changed so.
TEST(Stepping, refuses_to_change_loads_that_are_not_free) {
  auto c = tie();
  c.stages = {{{}, "first", 3e-4}, {{}, "second", 3e-4}};
  model::ForceSpec push;
  push.name = "push", push.stage = "second", push.where = plane(0, 0.6), push.direction = {0, 0, -1};
  push.curve = constant(500);
  c.forces = {push};
  c.gravity.on = true, c.gravity.curve = constant(9.81);
  c.motions[0].path = model::PathSpec{};
  c.motions[0].path->speed = 1, c.motions[0].path->turn = 1e-4;
  c.motions[0].path->targets = {{{}, "force", 1e3, "1 kN"}};
  sim::RunOptions o;
  o.quiet = true, o.threads = 1;
  sim::Run run(c, o);
  run.open();
  EXPECT_EQ(refusal(run, "push", "force"), "`push` begins with the stage `second`, which has not begun yet");
  EXPECT_EQ(refusal(run, "pull", "velocity"),
            "`pull` follows a path that gauges steer: it cannot be changed");
  EXPECT_EQ(refusal(run, "gravity", "force"), "gravity has an `acceleration`, no `force`");
}

// Requirement: a run that is finished early says so, and two runs may live side by side and end in any order.
TEST(Stepping, two_runs_side_by_side) {
  sim::RunOptions o;
  o.quiet = true, o.threads = 2;
  auto first = std::make_unique<sim::Run>(tie(), o);
  auto second = std::make_unique<sim::Run>(tie(), o);
  first->open(), second->open();
  for (int i = 0; i < 20; ++i) first->step(), second->step();
  EXPECT_EQ(first->finish().status, "stopped");
  EXPECT_FALSE(first->step());
  first.reset();
  while (second->step()) {
  }
  EXPECT_EQ(second->finish().status, "complete");
}

} // namespace
} // namespace fissura::support
