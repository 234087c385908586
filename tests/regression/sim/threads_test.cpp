// The same bits on any number of threads and in every repetition.
#include <gtest/gtest.h>

#include "fissura/concrete/concrete.hpp"
#include "fissura/parallel/parallel.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/sim/state_hash.hpp"
#include "support/cases.hpp"

namespace fissura::support {
namespace {

struct Outcome {
  std::uint64_t hash = 0;
  double held = 0, dissipated = 0, work = 0, reaction = 0;
  int damaged = 0, activated = 0;
};

Outcome run(model::Case const& c, int threads, long steps) {
  parallel::Threads const limit(threads);
  Stepper x(c);
  x.advance(steps);
  x.read();
  return {sim::state_hash(x.m, x.s),
          x.e.held(),
          x.e.dissipated(),
          x.e.work(),
          x.s.reaction.back(),
          concrete::count_joints(x.m, x.s).damaged,
          sim::count_bars(x.s.bars).activated};
}

void expect_same(Outcome const& a, Outcome const& b) {
  EXPECT_EQ(a.hash, b.hash);
  EXPECT_EQ(a.held, b.held);
  EXPECT_EQ(a.dissipated, b.dissipated);
  EXPECT_EQ(a.work, b.work);
  EXPECT_EQ(a.reaction, b.reaction);
}

// Requirement: a tie that cracks and slips on 1, 2, 3 and 8 threads ends in the same state, with the same
// energies and reactions, to the bit; and so does a repetition.
TEST(Threads, give_the_same_bits_in_a_cracking_tie) {
  auto c = tie_case({8, 4, 4}, 1, 2);
  auto const one = run(c, 1, 1500);
  EXPECT_GT(one.damaged, 20);
  EXPECT_GT(one.activated, 0);
  for (int const threads : {1, 2, 3, 8}) expect_same(one, run(c, threads, 1500));
}

// Requirement: the same with bonded tets, whose corner forces are summed, gravity and all kinds of damping.
TEST(Threads, give_the_same_bits_in_a_bonded_body) {
  auto c = tie_case({8, 4, 4}, 1, 2);
  c.concretes[0].joints = false;
  c.concretes[0].mu_bar = 1e4;
  c.bars.clear();
  c.gravity.on = true;
  c.gravity.curve = constant(9.81);
  c.run.mass_damping = 20, c.run.local_damping = 0.05;
  auto const one = run(c, 1, 400);
  for (int const threads : {2, 3, 8}) expect_same(one, run(c, threads, 400));
}

// Requirement: the same with joint inertia, the points of which lie in many chunks.
TEST(Threads, give_the_same_bits_with_joint_inertia) {
  auto c = tie_case({8, 4, 4}, 1, 2);
  c.run.joint_inertia = model::JointInertia::on;
  auto const one = run(c, 1, 600);
  EXPECT_GT(one.damaged, 20);
  for (int const threads : {1, 2, 3, 8}) expect_same(one, run(c, threads, 600));
}

// Requirement: the hash tells states apart: one bit of one displacement, one damage value, one more step.
TEST(StateHash, tells_states_apart) {
  Stepper x(tie_case({4, 2, 2}, 1, 2));
  x.advance(600);
  ASSERT_GT(concrete::count_joints(x.m, x.s).damaged, 0);
  auto const hash = sim::state_hash(x.m, x.s);
  EXPECT_EQ(sim::state_hash(x.m, x.s), hash);
  double& u = x.s.u(17, 1);
  double const kept = u;
  u = std::nextafter(u, 1);
  EXPECT_NE(sim::state_hash(x.m, x.s), hash);
  u = kept;
  EXPECT_EQ(sim::state_hash(x.m, x.s), hash);
  x.s.v(3, 0) *= 1 + 1e-15;
  EXPECT_NE(sim::state_hash(x.m, x.s), hash);
}

} // namespace
} // namespace fissura::support
