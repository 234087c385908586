// Absorbing boundaries: what reaches them leaves the model, and its energy has an account.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fissura/model/impedance.hpp"
#include "support/cases.hpp"

namespace fissura::support {
namespace {

constexpr double length = 2, width = 0.05, amplitude = 1e5;

/// A smooth push on x = 0 that lasts for `pulse` [s], for a wave about 1 m long; the rest is held so that
/// waves stay plane.
model::Case column(bool joints, int axis, double pulse) {
  auto c = box_case({40, 1, 1}, {length, width, width}, 1);
  c.concretes[0].joints = joints;
  c.concretes[0].crackable = false;
  if (axis == 0) {
    for (double const at : {0.0, width}) {
      c.supports.push_back(support_at("y" + std::to_string(at), plane(1, at), {false, true, false}));
      c.supports.push_back(support_at("z" + std::to_string(at), plane(2, at), {false, false, true}));
    }
  } else {
    c.supports = {support_at("shear only", everything(), {true, false, true})};
  }
  model::TractionSpec push;
  push.name = "push", push.where = plane(0, 0);
  push.direction = axis == 0 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  push.curve.kind = model::Curve::Kind::table;
  for (int i = 0; i <= 60; ++i) {
    push.curve.times.push_back(pulse * i / 60);
    push.curve.values.push_back(amplitude * 0.5 * (1 - std::cos(2 * std::numbers::pi * i / 60)));
  }
  c.tractions = {push};
  c.absorbing = {{{}, "end", plane(0, length)}};
  return c;
}

struct Passage {
  double incident = 0,
         reflected = 0; ///< largest |v| at the middle before and after the pulse has gone by [m/s]
  double left = 0;      ///< share of the work that is still in the column at the end
  double absorbed = 0;  ///< share of the work
  double residual = 0;
};

Passage send(model::Case const& c, int axis, double speed) {
  double const pulse = c.tractions[0].curve.times.back();
  Stepper x(c);
  std::vector<int> middle;
  for (int n = 0; n < node_count(x.m); ++n)
    if (std::abs(position(x.m, n).x - length / 2) < 1e-9) middle.push_back(n);
  double const gone = pulse + 1.25 * length / 2 / speed, end = 1.1 * (pulse + 1.5 * length / speed);
  Passage p;
  while (x.s.time < end) {
    x.advance();
    double v = 0;
    for (int const n : middle) v += at_node(x.s.v, n)[axis] / static_cast<double>(middle.size());
    double& largest = x.s.time < gone ? p.incident : p.reflected;
    largest = std::max(largest, std::abs(v));
  }
  auto const& e = x.read();
  p.left = e.held() / e.work();
  p.absorbed = e.absorbed / e.work();
  p.residual = e.missing() / e.work();
  return p;
}

constexpr double M = 30e9 * 0.8 / (1.2 * 0.6), G = 30e9 / 2.4, rho = 2500;

// Requirement: at normal incidence less than 1 % of the velocity of a plane compression wave comes back, also
// where joints soften the body by 11 %, and the energy is in the account `absorbed`.
TEST(Absorbing, lets_compression_waves_out) {
  for (bool const joints : {false, true}) {
    auto const p = send(column(joints, 0, 3e-4), 0, std::sqrt(M / rho));
    EXPECT_GT(p.incident, 0.9 * amplitude / std::sqrt(rho * M));
    EXPECT_LT(p.reflected, 0.01 * p.incident) << (joints ? "with joints" : "bonded");
    EXPECT_LT(p.left, 1e-3);
    EXPECT_GT(p.absorbed, 0.99);
    EXPECT_LT(std::abs(p.residual), 1e-3);
    RecordProperty(joints ? "reflected_with_joints" : "reflected", std::to_string(p.reflected / p.incident));
  }
}

// Requirement: the same holds for a shear wave, whose dashpots are weaker.
TEST(Absorbing, lets_shear_waves_out) {
  auto const p = send(column(false, 1, 5e-4), 1, std::sqrt(G / rho));
  EXPECT_LT(p.reflected, 0.01 * p.incident);
  EXPECT_LT(std::abs(p.residual), 1e-3);
}

// Requirement: without it the wave comes back whole.
TEST(Absorbing, is_what_lets_them_out) {
  auto c = column(false, 0, 3e-4);
  c.absorbing.clear();
  auto const p = send(c, 0, std::sqrt(M / rho));
  EXPECT_GT(p.reflected, 0.9 * p.incident);
}

// Requirement: the stable step stays as it is: at the step chosen without dashpots a column that is absorbed
// on all sides, tets owning their nodes, comes to rest from noise of all frequencies.
TEST(Absorbing, does_not_change_the_stable_step) {
  auto c = box_case({3, 1, 1}, {0.3, 0.1, 0.1}, 1);
  c.concretes[0].crackable = false;
  c.run.joint_inertia = model::JointInertia::off;
  Stepper bare(c);
  c.absorbing = {{{}, "all", everything()}};
  Stepper x(c);
  EXPECT_EQ(x.m.dt, bare.m.dt);
  std::uint64_t seed = 1;
  for (double& v : x.s.v.values)
    seed = seed * 6364136223846793005u + 1442695040888963407u, v = 1e-3 * (seed >> 40) / 16777216.0;
  double const start = x.read().held();
  x.advance(3000);
  EXPECT_LT(x.read().held(), 0.01 * start);
}

// Requirement: without joints the impedance is rho c_p along the normal and rho c_s across it, whatever the
// direction; with joints of equal fabric both fall as the root of the series stiffness.
TEST(Impedance, is_that_of_plane_waves) {
  for (Vec3 const n : {Vec3{1, 0, 0}, unit(Vec3{1, -2, 3})}) {
    auto concrete = plain_concrete();
    concrete.joints = false;
    auto const m = concrete_model(box_mesh({2, 2, 2}, {1, 1, 1}), concrete);
    Mat3 const z = model::impedance(model::acoustic_tensor(model::jointed_stiffness(m, 0), n), rho);
    Vec3 const across = unit(cross(n, Vec3{0.3, 0.5, 0.7}));
    EXPECT_NEAR(dot(n, z * n), std::sqrt(rho * M), 1e-9 * std::sqrt(rho * M));
    EXPECT_NEAR(dot(across, z * across), std::sqrt(rho * G), 1e-9 * std::sqrt(rho * M));
    EXPECT_NEAR(dot(n, z * across), 0, 1e-6 * std::sqrt(rho * M));
  }
}

} // namespace
} // namespace fissura::support
