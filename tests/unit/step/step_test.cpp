#include <gtest/gtest.h>

#include "count_allocations.hpp"
#include "fissura/concrete/concrete.hpp"
#include "fissura/parallel/parallel.hpp"
#include "fissura/step/stable_step.hpp"
#include "support/reinforced_model.hpp"

namespace fissura::support {
namespace {

model::Model tie() {
  auto m = reinforced_model(random_box_mesh(41, {4, 2, 2}, {0.4, 0.2, 0.2}), plain_concrete(),
                            {straight_bar({0, 0.09, 0.11}, {0.4, 0.1, 0.1}, 0.02)});
  m.source.run.joint_inertia = model::JointInertia::off; // joints as stiff as in a model without it
  m.dt = 0.9 * step::stable_step(m).dt;
  return m;
}

/// Pulls the ends apart by giving every node a velocity that grows along x.
void pull(model::Model const& m, state::State& s, double rate) {
  set_field(m, s.v, [&](Vec3 X) { return Vec3{rate * (X.x - 0.2), 0, 0}; });
}

// Requirement: the first state is at rest with all joints intact, and sized for whole blocks.
TEST(State, starts_at_rest) {
  auto const m = tie();
  auto const s = step::make_state(m);
  EXPECT_EQ(s.u.nodes() % (4 * model::block), 0u);
  for (double const x : s.u.values) EXPECT_EQ(x, 0);
  for (double const x : s.v.values) EXPECT_EQ(x, 0);
  EXPECT_EQ(concrete::count_joints(m, s).damaged, 0);
  EXPECT_EQ(s.bars.history.size(), m.bars.joints.size());
  EXPECT_EQ(s.step, 0);
}

// Requirement: time is steps times dt, without a sum that drifts.
TEST(Step, counts_time_by_steps) {
  auto const m = tie();
  auto s = step::make_state(m);
  auto w = step::make_scratch(m, s);
  for (int i = 0; i < 1000; ++i) step::advance(m, s, w);
  EXPECT_EQ(s.step, 1000);
  EXPECT_EQ(s.time, 1000 * m.dt);
}

// Requirement: a body at rest without loads stays at rest, to the bit.
TEST(Step, rest_stays_rest) {
  auto const m = tie();
  auto s = step::make_state(m);
  auto w = step::make_scratch(m, s);
  for (int i = 0; i < 100; ++i) step::advance(m, s, w);
  for (double const x : s.u.values) ASSERT_EQ(x, 0);
  for (double const x : s.v.values) ASSERT_EQ(x, 0);
}

// Requirement: a step allocates nothing, elastic or cracking.
TEST(Step, allocates_nothing) {
  parallel::Threads const one(1);
  auto const m = tie();
  auto s = step::make_state(m);
  auto w = step::make_scratch(m, s);
  pull(m, s, 5);
  for (int i = 0; i < 5; ++i) step::advance(m, s, w);
  long const before = allocations();
  for (int i = 0; i < 300; ++i) step::advance(m, s, w);
  EXPECT_EQ(allocations() - before, 0);
  EXPECT_GT(concrete::count_joints(m, s).damaged, 0) << "the test should have cracked the tie";
}

// Requirement: a step allocates nothing while a body presses and slides on a plane and its near faces stay
// the same.
TEST(Step, allocates_nothing_on_a_plane) {
  parallel::Threads const one(1);
  auto m = tie();
  model::RigidBody floor;
  floor.axis = {0, 0, 1}, floor.friction = 0.6;
  m.rigid = {floor};
  auto s = step::make_state(m);
  auto w = step::make_scratch(m, s);
  set_field(m, s.v, [](Vec3) { return Vec3{0.02, 0, -0.05}; });
  for (int i = 0; i < 5; ++i) step::advance(m, s, w);
  long const before = allocations();
  for (int i = 0; i < 30; ++i) {
    step::advance(m, s, w);
    ASSERT_FALSE(s.rigid.touch.empty());
  }
  EXPECT_EQ(allocations() - before, 0);
  EXPECT_GT(s.ledger.contact_friction, 0);
}

// Requirement: a reading of the ledger changes nothing in the state, to the bit.
TEST(Step, reading_the_ledger_changes_nothing) {
  auto const m = tie();
  auto a = step::make_state(m), b = step::make_state(m);
  auto wa = step::make_scratch(m, a), wb = step::make_scratch(m, b);
  pull(m, a, 5), pull(m, b, 5);
  step::EnergyBalance e;
  for (int i = 0; i < 200; ++i) {
    step::advance(m, a, wa, &e);
    step::advance(m, b, wb);
  }
  for (std::size_t i = 0; i < a.u.values.size(); ++i) {
    ASSERT_EQ(a.u.values[i], b.u.values[i]);
    ASSERT_EQ(a.v.values[i], b.v.values[i]);
  }
  EXPECT_EQ(a.ledger.viscous, b.ledger.viscous);
}

// Requirement: the accounts of a reading add up as held, dissipated, work and missing, each counted once.
TEST(EnergyBalance, adds_up) {
  step::EnergyBalance e;
  e.kinetic = 1, e.strain = 2, e.joints = 4, e.bars = 8, e.bar_joints = 16;
  e.fracture_I = 32, e.fracture_II = 64, e.friction = 128, e.bond_steel = 256, e.dowel = 512,
  e.rupture = 1024;
  e.viscous = 2048, e.mass_damping = 4096, e.local_damping = 8192;
  e.work_supports = 16384, e.work_forces = 32768, e.work_gravity = 65536;
  e.start = 131072;
  EXPECT_EQ(e.internal(), 2 + 4 + 8 + 16);
  EXPECT_EQ(e.held(), 31);
  EXPECT_EQ(e.dissipated(), 16384 - 32);
  EXPECT_EQ(e.work(), 131072 - 16384);
  EXPECT_EQ(e.missing(), 131072 + 131072 - 16384 - 31 - (16384 - 32));
  double sum = 0;
  for (auto const& [name, value] : e.accounts()) {
    EXPECT_FALSE(name.empty());
    sum += value;
  }
  EXPECT_EQ(sum, 131071);
}

} // namespace
} // namespace fissura::support
