// Large rigid motions: a body that only turns has no stress, no forces and loses no energy.
#include <gtest/gtest.h>

#include <numbers>

#include "support/corner_forces.hpp"

namespace fissura::support {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

void turn(model::Model const& m, state::State& s, Vec3 axis, double angle) {
  Mat3 const H = rotation_minus_identity(axis, angle);
  set_field(m, s.u, [&](Vec3 X) { return H * X; });
}

double largest_force(core::Buffer<double> const& force) {
  double largest = 0;
  for (double const f : force) largest = std::max(largest, std::abs(f));
  return largest;
}

class Turning : public testing::TestWithParam<model::TetLaw> {};

// Requirement: under rotation through 360 degrees the stress stays below 1e-10 E and the tet forces below
// 1e-10 of E times the face area, in both laws and every kernel set.
TEST_P(Turning, causes_no_stress_and_no_force) {
  auto concrete = plain_concrete();
  concrete.tet_law = GetParam();
  auto const m = concrete_model(random_box_mesh(3, {3, 2, 2}, {0.3, 0.2, 0.2}), concrete);
  auto s = concrete_state(m);
  auto w = concrete_scratch(m);
  double stress = 0, force = 0, strain_energy = 0;
  core::NodeField f;
  for (int degrees = 0; degrees <= 360; degrees += 5) {
    turn(m, s, {1, -2, 0.5}, degrees * two_pi / 360);
    for (int t = 0; t < m.tet_count(); ++t)
      for (double const x : concrete::tet_stress(m, s, t)) stress = std::max(stress, std::abs(x));
    for (char const* name : {"scalar", "v2"}) {
      corner_forces(m, s, w, 0, f, concrete::kernels(name));
      force = std::max(force, largest_force(f.values));
    }
    corner_forces(m, s, w, 0, f);
    force = std::max(force, largest_force(f.values));
    strain_energy = std::max(strain_energy, std::abs(concrete::strain_energy(m, s)));
  }
  EXPECT_LE(stress, 1e-10 * concrete.E);
  EXPECT_LE(force, 1e-10 * concrete.E * 0.1 * 0.1);
  EXPECT_LE(strain_energy, 1e-14 * concrete.E * 0.3 * 0.2 * 0.2);
}
INSTANTIATE_TEST_SUITE_P(Laws, Turning, testing::Values(model::TetLaw::hyperelastic, model::TetLaw::paper),
                         [](auto const& i) {
                           return i.param == model::TetLaw::paper ? "paper" : "hyperelastic";
                         });

// Requirement: joints carry nothing in a rigid motion, however large.
TEST(RigidMotion, loads_no_joint) {
  auto const m = concrete_model(random_box_mesh(4, {2, 2, 2}, {0.2, 0.2, 0.2}));
  auto s = concrete_state(m);
  auto w = concrete_scratch(m);
  for (int degrees = 0; degrees <= 360; degrees += 15) {
    turn(m, s, {0.3, 1, 2}, degrees * two_pi / 360);
    concrete::joint_forces(m, s, w);
    EXPECT_LE(largest_force(w.joints.force), 1e-12 * plain_concrete().E * 0.1 * 0.1) << degrees;
  }
  EXPECT_EQ(concrete::count_joints(m, s).damaged, 0);
  EXPECT_LE(concrete::joint_energy(m, s), 1e-20);
}

// Requirement: with mu_bar > 0 a rigid spin (v = omega x r at the turned position) dissipates less than 1e-12
// of what a shear of the same rate would.
TEST(RigidMotion, rigid_spin_dissipates_nothing) {
  auto concrete = plain_concrete();
  concrete.mu_bar = 1e5;
  auto const m = concrete_model(random_box_mesh(5, {2, 2, 2}, {0.2, 0.2, 0.2}), concrete);
  auto s = concrete_state(m);
  auto w = concrete_scratch(m);
  core::NodeField f;
  Vec3 const spin{30, -20, 50};
  double const dt = 1e-6, of_shear = concrete.mu_bar * dot(spin, spin) * 0.2 * 0.2 * 0.2 * dt;
  for (int degrees = 0; degrees < 360; degrees += 30) {
    turn(m, s, spin, degrees * two_pi / 360);
    for (int n = 0; n < node_count(m); ++n) set_node(s.v, n, cross(spin, position(m, n) + at_node(s.u, n)));
    EXPECT_LE(std::abs(corner_forces(m, s, w, dt, f)), 1e-12 * of_shear) << degrees;
    EXPECT_LE(largest_force(f.values), 1e-10 * concrete.E * 0.01);
  }
}

// Requirement: Eq. 8's viscous stress is mu_bar D: a stretching rate d along x dissipates mu_bar d^2 per
// volume.
TEST(RigidMotion, stretching_dissipates_as_eq_8_says) {
  auto concrete = plain_concrete();
  concrete.mu_bar = 1e5;
  auto const m = concrete_model(random_box_mesh(6, {2, 2, 2}, {0.2, 0.2, 0.2}), concrete);
  auto s = concrete_state(m);
  auto w = concrete_scratch(m);
  core::NodeField f;
  set_field(m, s.v, [](Vec3 X) { return Vec3{0.5 * X.x, 0, 0}; });
  double const dt = 1e-6;
  EXPECT_NEAR(corner_forces(m, s, w, dt, f), concrete.mu_bar * 0.25 * 0.008 * dt,
              1e-12 * concrete.mu_bar * 0.25 * 0.008 * dt);
  double power = 0;
  for (int n = 0; n < node_count(m); ++n) power -= dot(at_node(f, n), at_node(s.v, n));
  EXPECT_NEAR(power, concrete.mu_bar * 0.25 * 0.008, 1e-9 * concrete.mu_bar * 0.25 * 0.008);
}

} // namespace
} // namespace fissura::support
