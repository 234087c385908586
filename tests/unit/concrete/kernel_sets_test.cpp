// The kernels of every instruction set against the scalar one.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/damaged_joints.hpp"
#include "fissura/concrete/kernels.hpp"
#include "fissura/core/error.hpp"
#include "support/concrete_model.hpp"

namespace fissura::support {
namespace {

using concrete::KernelSet;

/// A model that runs with one kernel set, called without the library's own choice of set.
struct Bench {
  model::Model m;
  state::State s;
  state::Scratch w;
  double mass_damping = 0, local_damping = 0;
  Vec3 gravity;
  state::TetSums sums;

  explicit Bench(model::ConcreteSpec const& concrete)
      : m(concrete_model(random_box_mesh(21, {3, 3, 1}, {0.3, 0.3, 0.1}), concrete)), s(concrete_state(m)),
        w(concrete_scratch(m)) {
    m.dt = 2e-7;
  }
  /// Every node its own displacement and velocity.
  void shake(double displacement, double velocity) {
    Random random(9);
    for (int n = 0; n < node_count(m); ++n) {
      set_node(s.u, n, random.vector(-displacement, displacement));
      set_node(s.v, n, random.vector(-velocity, velocity));
    }
  }
  /// Some tets with forces of bars or loads.
  void load_some_tets() {
    m.overlay_tets = {2, 3, 17, m.tet_count() - 1};
    for (int const tet : m.overlay_tets) w.overlay.slot_for(tet);
    for (std::size_t i = 0; i < w.overlay.force.size(); ++i)
      w.overlay.force[i] = 10.0 * static_cast<double>(i % 7);
  }
  void step(KernelSet const& set) {
    concrete::JointPass const joints{&m.joints, s.u.data(), w.joints.force.data(), s.joint_status.data()};
    std::vector<int> marked(m.joints.blocks() * model::block);
    int const count = set.joint_forces(joints, 0, m.joints.blocks(), marked.data());
    concrete::damaged_joints(set, m, s, w.joints, 0, marked.data(), count);
    concrete::TetPass const tets{&m.tets, s.u.data(),   s.v.data(),    &w.joints, &w.overlay, nullptr,
                                 m.dt,    mass_damping, local_damping, gravity,   gravity,    true};
    sums = set.tet_forces(tets, 0, m.tets.blocks());
  }
};

/// What the damaged joints hold [J], by their batches.
double batch_energy(KernelSet const& set, Bench const& b) {
  concrete::DamagedPass const pass{b.s.u.data(), b.w.joints.laws.data(), nullptr};
  double sum = 0;
  for (std::size_t g = 0; g < b.w.joints.lanes.size(); ++g)
    for (int lane = 0; lane < b.w.joints.lanes[g].at_work; lane += model::block) {
      std::size_t const row = state::JointHistories::place(g, lane) / model::block;
      sum += set.batch_energy(pass, b.w.joints.batches[row], b.s.joint_history.rows[row]);
    }
  return sum;
}

double largest(core::Buffer<double> const& a) {
  double most = 0;
  for (double const x : a) most = std::max(most, std::abs(x));
  return most;
}
/// Largest difference over the largest size.
double difference(core::Buffer<double> const& a, core::Buffer<double> const& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most / largest(a);
}
double difference(double a, double b) {
  return std::abs(a - b) / std::max({std::abs(a), std::abs(b), 1e-300});
}

class KernelSets : public testing::TestWithParam<char const*> {
 protected:
  void SetUp() override {
    try {
      set_ = &concrete::kernels(GetParam());
    } catch (core::Error const&) {
      GTEST_SKIP() << "this machine cannot run " << GetParam();
    }
  }
  void expect_same_step(Bench& oracle, Bench& other) {
    oracle.step(concrete::kernels("scalar"));
    other.step(*set_);
    EXPECT_GT(largest(oracle.w.joints.force), 0);
    EXPECT_LE(difference(oracle.w.joints.force, other.w.joints.force), 1e-12);
    EXPECT_LE(difference(oracle.s.u.values, other.s.u.values), 1e-12);
    EXPECT_LE(difference(oracle.s.v.values, other.s.v.values), 1e-12);
    EXPECT_TRUE(
        std::equal(oracle.s.joint_status.begin(), oracle.s.joint_status.end(), other.s.joint_status.begin()));
    EXPECT_LE(difference(batch_energy(concrete::kernels("scalar"), oracle), batch_energy(*set_, other)),
              1e-12);
    EXPECT_LE(difference(oracle.sums.kinetic.at_n, other.sums.kinetic.at_n), 1e-12);
    EXPECT_LE(difference(oracle.sums.viscous, other.sums.viscous), 1e-12);
    EXPECT_LE(difference(oracle.sums.gravity, other.sums.gravity), 1e-11); // a sum of both signs
    EXPECT_LE(difference(oracle.sums.local_damping, other.sums.local_damping), 1e-12);
  }
  KernelSet const* set_ = nullptr;
};

// Requirement: one step of an elastic, viscous, damped, loaded model gives the scalar kernel's numbers to
// 1e-12.
TEST_P(KernelSets, agree_on_an_elastic_step) {
  auto concrete = plain_concrete();
  concrete.mu_bar = 1e4;
  Bench oracle(concrete), other(concrete);
  for (Bench* b : {&oracle, &other}) {
    b->shake(1e-7, 0.1);
    b->load_some_tets();
    b->gravity = {0.3, -0.1, -9.81};
    b->mass_damping = 50;
    b->local_damping = 0.3;
  }
  expect_same_step(oracle, other);
}

// Requirement: the same for the law `paper`.
TEST_P(KernelSets, agree_on_the_law_paper) {
  auto concrete = plain_concrete();
  concrete.tet_law = model::TetLaw::paper;
  concrete.mu_bar = 1e4;
  Bench oracle(concrete), other(concrete);
  for (Bench* b : {&oracle, &other})
    b->shake(1e-7, 0.1), b->gravity = {0, 0, -9.81}, b->mass_damping = 1, b->local_damping = 0.1;
  expect_same_step(oracle, other);
}

// Requirement: with constant shear strength and joints far beyond their strength, the same joints go to the
// full law.
TEST_P(KernelSets, agree_on_a_cracking_step) {
  auto concrete = plain_concrete();
  concrete.shear = model::ShearStrength::constant;
  concrete.f_s = 5e6;
  concrete.mu_bar = 1e4;
  Bench oracle(concrete), other(concrete);
  for (Bench* b : {&oracle, &other})
    b->shake(1e-5, 0.1), b->gravity = {0, 0, -9.81}, b->mass_damping = 1, b->local_damping = 0.1;
  expect_same_step(oracle, other);
  EXPECT_GT(concrete::count_joints(oracle.m, oracle.s).damaged, 0);
  EXPECT_GT(batch_energy(*set_, other), 0);
}

// Requirement: the same where strengths depend on the strain rate and joints are straight up to them.
TEST_P(KernelSets, agree_on_a_step_with_rate_factor) {
  auto concrete = plain_concrete();
  concrete.rate_factor = model::RateFactor::mc2010;
  for (double const size : {1e-7, 1e-5}) {
    Bench oracle(concrete), other(concrete);
    for (Bench* b : {&oracle, &other}) b->shake(size, 0.1);
    expect_same_step(oracle, other);
  }
}

// Requirement: after 1,000 uncracked steps the sets still agree to 1e-9.
TEST_P(KernelSets, agree_after_a_thousand_uncracked_steps) {
  auto const concrete = plain_concrete();
  Bench oracle(concrete), other(concrete);
  for (Bench* b : {&oracle, &other}) {
    b->shake(0, 1e-3);
    b->load_some_tets();
    b->mass_damping = 50;
    b->gravity = {0, 0, -9.81};
  }
  for (int i = 0; i < 1000; ++i) {
    oracle.step(concrete::kernels("scalar"));
    other.step(*set_);
  }
  EXPECT_EQ(concrete::count_joints(oracle.m, oracle.s).damaged, 0);
  EXPECT_LE(difference(oracle.s.u.values, other.s.u.values), 1e-9);
  EXPECT_LE(difference(oracle.s.v.values, other.s.v.values), 1e-9);
}

// Requirement: padding lanes stay at rest and harm nobody.
TEST_P(KernelSets, leave_padding_at_rest) {
  Bench b(plain_concrete());
  // 54 tets: the last block has two lanes of padding
  ASSERT_NE(b.m.tet_count() % model::block, 0);
  b.shake(1e-6, 0.1);
  for (int i = 0; i < 10; ++i) b.step(*set_);
  for (std::size_t i = 12 * static_cast<std::size_t>(b.m.tet_count()); i < b.s.u.values.size(); ++i) {
    EXPECT_EQ(b.s.u.values[i], 0);
    EXPECT_EQ(b.s.v.values[i], 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, KernelSets, testing::Values("v2", "v3", "v4"),
                         [](auto const& i) { return i.param; });

// Requirement: an unknown kernel set is refused with the names there are.
TEST(KernelChoice, refuses_unknown_names) {
  try {
    concrete::kernels("v9");
    FAIL();
  } catch (core::Error const& e) {
    EXPECT_NE(std::string(e.what()).find("scalar, v2, v3, v4"), std::string::npos);
  }
}

} // namespace
} // namespace fissura::support
