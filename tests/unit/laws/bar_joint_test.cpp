#include "fissura/laws/bar_joint.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "fissura/core/error.hpp"
#include "fissura/laws/bar_joint_uncracked.hpp"

namespace {
using namespace fissura::laws;

BarJointInput input(bool dowel = true) {
  BarJointInput in;
  in.D = 0.03385137501, in.A_s = 9e-4, in.f_c = 30e6, in.l_cr = 0.075, in.dowel = dowel;
  in.steel = {210e9, 530e6, 650e6, 0.03, 0.1, 0.12, SteelLaw::kato};
  return in;
}

BarJointHistory activated(BarJointParams const& p, double sigma_cr = 20e6) {
  BarJointHistory h;
  activate(p, h, 1e-6, {0, 2e-7, 0}, sigma_cr, 1e-3);
  return h;
}

// Activation changes neither the stress nor the energy.
TEST(BarJoint, ActivationIsContinuous) {
  auto const p = make_bar_joint_params(input());
  auto h = activated(p);
  EXPECT_DOUBLE_EQ(bar_joint_stored(p, h), 1e-3);
  BarJointDissipation lost;
  EXPECT_NEAR(bar_joint_force(p, h, 0, 0, lost).sigma, 20e6, 1e-6);
  EXPECT_NEAR(lost.bond_steel, 0, 1e-15);
  EXPECT_EQ(h.S_0, 1e-6);
  EXPECT_EQ(h.t_0.y, 2e-7);
}

// The slope on the elastic line is the bound that the stable step uses, and yield comes at f_y.
TEST(BarJoint, ElasticSlopeAndYield) {
  auto const p = make_bar_joint_params(input());
  auto h = activated(p);
  BarJointDissipation lost;
  double const sigma = bar_joint_force(p, h, 1e-5, 0, lost).sigma;
  EXPECT_NEAR((sigma - 20e6) * p.A_s / 2e-5, bar_joint_stiffness_bound(p),
              1e-6 * bar_joint_stiffness_bound(p));
  double const alpha = 0.087 * 0.075 / 0.03385137501, K_fc = std::pow(1.5, 2.0 / 3);
  double const bound = 210e9 * 9e-4 * K_fc / (2 * 0.03385137501 * alpha * (2 + 3500 * 530.0 / 210e3));
  EXPECT_NEAR(bar_joint_stiffness_bound(p), bound, 1e-9 * bound);
  for (double S = 1e-5; S < 1e-3; S += 1e-6) bar_joint_force(p, h, S, 0, lost);
  EXPECT_TRUE(h.yielded);
  EXPECT_GE(h.sigma, 530e6);
  EXPECT_NEAR(lost.dowel, 0, 0);
}

// Requirement: a joint that is pressed past -f_y has yielded too, although its bond never did.
TEST(BarJoint, YieldsInCompression) {
  auto const p = make_bar_joint_params(input());
  auto h = activated(p);
  BarJointDissipation lost;
  for (double S = 0; h.strain > -0.95 * 530e6 / 210e9; S -= 1e-6) bar_joint_force(p, h, S, 0, lost);
  EXPECT_FALSE(h.yielded);
  while (h.strain > -1.05 * 530e6 / 210e9) bar_joint_force(p, h, h.S - 1e-6, 0, lost);
  EXPECT_TRUE(h.yielded);
  EXPECT_FALSE(h.bond.yielded);
  EXPECT_NEAR(h.sigma, -530e6, 1e-3 * 530e6);
}

// On the elastic line the stored energy is the work of the force over the slip, and nothing is lost.
TEST(BarJoint, ElasticWorkIsStored) {
  auto const p = make_bar_joint_params(input());
  auto h = activated(p);
  BarJointDissipation lost;
  double const sigma = bar_joint_force(p, h, 1e-4, 0, lost).sigma;
  EXPECT_FALSE(h.yielded);
  EXPECT_NEAR(bar_joint_stored(p, h), 1e-3 + p.A_s * (20e6 + sigma) * 1e-4, 1e-9);
  EXPECT_NEAR(lost.bond_steel, 0, 1e-9);
}

// The bar ruptures past eps_br: it lets go for good and what it held is booked as lost.
TEST(BarJoint, RupturesByStrain) {
  auto const p = make_bar_joint_params(input());
  auto h = activated(p);
  BarJointDissipation lost;
  double work = 0, sigma = 20e6, S = 0;
  while (!h.ruptured && S < 1) {
    double const next = bar_joint_force(p, h, S + 1e-6, 0, lost).sigma;
    work += p.A_s * (sigma + next) * 1e-6, sigma = next, S += 1e-6;
  }
  EXPECT_TRUE(h.ruptured);
  EXPECT_GT(h.strain, 0.12);
  EXPECT_EQ(bar_joint_stored(p, h), 0);
  EXPECT_NEAR(lost.bond_steel, work + 1e-3, 1e-6 * work);
  auto const f = bar_joint_force(p, h, 0, 0, lost);
  EXPECT_EQ(f.sigma, 0);
  EXPECT_EQ(f.V_s, 0);
}

// A bar is cut when the crack faces have slid past each other by six diameters (three at each face).
TEST(BarJoint, RupturesByOffset) {
  for (bool dowel : {true, false}) {
    auto const p = make_bar_joint_params(input(dowel));
    auto h = activated(p);
    BarJointDissipation lost;
    bar_joint_force(p, h, 0, 2.99 * p.D, lost);
    EXPECT_FALSE(h.ruptured);
    bar_joint_force(p, h, 0, 3.01 * p.D, lost);
    EXPECT_TRUE(h.ruptured);
  }
}

// A bar whose shear stress reaches f_y/sqrt(3) has no strength left and is cut.
TEST(BarJoint, RupturesByShear) {
  auto in = input();
  in.steel.f_y = 100e6, in.steel.f_u = 150e6;
  auto const p = make_bar_joint_params(in);
  auto h = activated(p);
  BarJointDissipation lost;
  for (double t = 0; t < 3e-3 && !h.ruptured; t += 1e-6) bar_joint_force(p, h, 0, t, lost);
  EXPECT_TRUE(h.ruptured);
  EXPECT_GT(lost.dowel, 0);
}

// Without dowel action sliding across the crack costs no force and no strength.
TEST(BarJoint, DowelOff) {
  auto const p = make_bar_joint_params(input(false));
  auto h = activated(p);
  BarJointDissipation lost;
  EXPECT_EQ(bar_joint_force(p, h, 1e-4, 1e-3, lost).V_s, 0);
  EXPECT_EQ(h.dowel.strength, 1);
}

// A missing crack distance is refused by name.
TEST(BarJoint, BadParametersAreNamed) {
  auto in = input();
  in.l_cr = 0;
  try {
    make_bar_joint_params(in);
    FAIL();
  } catch (fissura::core::Error const& e) {
    EXPECT_NE(std::string(e.what()).find("l_cr"), std::string::npos);
  }
}

// Before cracking: (E_s/E_c) times the parabola of the joints in series, linear in compression or if
// uncrackable.
TEST(UncrackedBarJoint, StressAndEnergy) {
  double const n = 7, p = 6e11, H = 0.05, f_t = 3e6, A_s = 9e-4, d_peak = 2 * f_t * H / p;
  auto const u = uncracked_bar_joint(n, p, H, f_t, A_s, true);
  for (double x : {0.2, 0.7, 1.0}) {
    EXPECT_NEAR(u.stress(x * d_peak), n * f_t * (2 * x - x * x), 1e-6);
    EXPECT_NEAR(u.stored(x * d_peak), A_s * n * f_t * d_peak * (x * x - x * x * x / 3), 1e-15);
  }
  EXPECT_NEAR(u.stress(1.5 * d_peak), n * f_t, 1e-6);
  EXPECT_NEAR(u.stored(1.5 * d_peak), A_s * n * f_t * d_peak * (2.0 / 3 + 0.5), 1e-15);
  EXPECT_NEAR(u.stress(-1e-7), -n * p / H * 1e-7, 1e-6);
  EXPECT_NEAR(u.stiffness_bound(), n * p / H * A_s, 1e-3);
  auto const linear = uncracked_bar_joint(n, p, H, f_t, A_s, false);
  EXPECT_NEAR(linear.stress(3 * d_peak), n * p / H * 3 * d_peak, 1e-3);
  EXPECT_NEAR(linear.stored(3 * d_peak), 0.5 * A_s * n * p / H * 9 * d_peak * d_peak, 1e-12);
}
} // namespace
