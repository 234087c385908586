#include "fissura/laws/cohesive.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "fissura/core/error.hpp"
#include "fissura/laws/softening.hpp"
#include "support/cohesive_input.hpp"

namespace {
using namespace fissura;
using namespace fissura::laws;

Traction at(CohesiveParams const& p, CohesiveHistory& h, Separation s, bool broken = false) {
  Dissipation lost;
  return cohesive_traction(p, h, s, s, broken, lost);
}

// The derived lengths follow Eq. 13 and the exact softening range.
TEST(Cohesive, DerivedParameters) {
  auto const p = make_cohesive_params(support::cohesive_input(false));
  EXPECT_DOUBLE_EQ(p.k, 1.5e14);
  EXPECT_DOUBLE_EQ(p.o_p, 4e-8);
  EXPECT_NEAR(p.o_r, 100 / 0.386307294744 / 3e6, 1e-16);
  auto in = support::cohesive_input(false);
  in.range = CohesiveRange::y3d;
  EXPECT_DOUBLE_EQ(make_cohesive_params(in).o_r, 3 * 100 / 3e6);
}

// Before damage the tension branch is the parabola of Eq. 13 and compression is linear.
TEST(Cohesive, TensionBeforeThePeak) {
  auto const p = make_cohesive_params(support::cohesive_input(false));
  CohesiveHistory h;
  double const x = 0.3;
  EXPECT_NEAR(at(p, h, {x * p.o_p, 0, 0}).sigma, p.f_t * (2 * x - x * x), 1e-6);
  EXPECT_NEAR(at(p, h, {p.o_p, 0, 0}).sigma, p.f_t, 1e-6);
  EXPECT_NEAR(at(p, h, {-1e-8, 0, 0}).sigma, -1.5e14 * 1e-8, 1e-6);
  EXPECT_EQ(h.kappa, 0);
}

// Shear before damage: a parabola for a constant strength, straight line for Mohr-Coulomb, along the sliding.
TEST(Cohesive, ShearBeforeThePeak) {
  auto const a = make_cohesive_params(support::cohesive_input(false)),
             b = make_cohesive_params(support::cohesive_input(true));
  CohesiveHistory h;
  double const s_p = 2 * 6e6 / a.k, s = 0.4 * s_p;
  auto const t = at(a, h, {0, 0.6 * s, 0.8 * s});
  EXPECT_NEAR(t.tau_1, 0.6 * 6e6 * (2 * 0.4 - 0.16), 1e-6);
  EXPECT_NEAR(t.tau_2, 0.8 * 6e6 * (2 * 0.4 - 0.16), 1e-6);
  EXPECT_NEAR(at(b, h, {0, 3e-8, 0}).tau_1, 1.5e14 * 3e-8, 1e-6);
  EXPECT_EQ(h.kappa, 0);
}

// In pure tension and pure shear both laws give z(D) times the strength (Eqs. 14-18).
TEST(Cohesive, SofteningInPureModes) {
  for (auto law : {CohesiveLaw::energy_consistent, CohesiveLaw::paper}) {
    auto const p = make_cohesive_params(support::cohesive_input(false, law));
    double const s_p = 2 * p.f_s / p.k, s_r = p.shear_work / p.f_s;
    for (double D : {0.01, 0.2, 0.7}) {
      CohesiveHistory h, g;
      EXPECT_NEAR(at(p, h, {p.o_p + D * p.o_r, 0, 0}).sigma, p.f_t * softening(D), 1e-3);
      EXPECT_NEAR(at(p, g, {0, 0, s_p + D * s_r}).tau_2, p.f_s * softening(D), 1e-3);
      EXPECT_NEAR(h.kappa, D, 1e-12);
      EXPECT_NEAR(g.kappa, D, 1e-12);
    }
  }
}

// Damage in both modes adds as a root of squares (Eq. 19) and is remembered after unloading.
TEST(Cohesive, MixedDamageIsRemembered) {
  auto const p = make_cohesive_params(support::cohesive_input(false));
  double const s_p = 2 * p.f_s / p.k, s_r = p.shear_work / p.f_s;
  CohesiveHistory h;
  at(p, h, {p.o_p + 0.3 * p.o_r, s_p + 0.4 * s_r, 0});
  EXPECT_NEAR(h.kappa, 0.5, 1e-12);
  auto const t = at(p, h, {});
  EXPECT_NEAR(h.kappa, 0.5, 1e-12);
  EXPECT_EQ(t.sigma, 0);
  EXPECT_EQ(t.tau_1, 0);
}

// Damage does not weaken a joint in compression.
TEST(Cohesive, NoDamageInCompression) {
  auto const p = make_cohesive_params(support::cohesive_input(false));
  CohesiveHistory h;
  at(p, h, {p.o_p + 0.5 * p.o_r, 0, 0});
  EXPECT_NEAR(at(p, h, {-2e-8, 0, 0}).sigma, -1.5e14 * 2e-8, 1e-6);
}

// Well past 5 % damage unloading of the default law is straight to the origin.
TEST(Cohesive, UnloadingIsSecant) {
  auto const p = make_cohesive_params(support::cohesive_input(false));
  CohesiveHistory h;
  double const o = p.o_p + 0.3 * p.o_r, sigma = at(p, h, {o, 0, 0}).sigma;
  EXPECT_NEAR(at(p, h, {0.5 * o, 0, 0}).sigma, 0.5 * sigma, 1e-6);
}

// Under pressure the Mohr-Coulomb strength grows by tan(phi), and the value at first damage stays.
TEST(Cohesive, MohrCoulombStrengthIsFrozen) {
  auto const p = make_cohesive_params(support::cohesive_input(true));
  double const pressure = 10e6, o = -pressure / p.k, f_s = 6e6 + pressure * std::tan(0.6283);
  CohesiveHistory h;
  at(p, h, {o, 0.999 * f_s / p.k, 0});
  EXPECT_EQ(h.kappa, 0);
  at(p, h, {o, 1.001 * f_s / p.k, 0});
  EXPECT_GT(h.kappa, 0);
  EXPECT_NEAR(h.f_s, f_s, 1);
  at(p, h, {0, 1.001 * f_s / p.k, 0});
  EXPECT_NEAR(h.f_s, f_s, 1);
}

// Once cohesion is gone the crack faces carry mu times the pressure and no more.
TEST(Cohesive, FrictionOfACrackFacePair) {
  for (bool mc : {false, true}) {
    auto const p = make_cohesive_params(support::cohesive_input(mc));
    CohesiveHistory h;
    Dissipation lost;
    double const o = -5e6 / p.k, end = 1e-3;
    Separation before{o, 0, 0};
    Traction t;
    for (int i = 1; i <= 4000; ++i) {
      Separation const now{o, end * i / 4000, 0};
      t = cohesive_traction(p, h, now, before, h.kappa >= 1, lost);
      before = now;
    }
    EXPECT_NEAR(t.sigma, -5e6, 1e-3);
    EXPECT_NEAR(t.tau_1, 0.6 * 5e6, 1);
    // reversing unloads along the spring k
    Separation const back{o, end - 1e-8, 0};
    t = cohesive_traction(p, h, back, before, true, lost);
    EXPECT_NEAR(t.tau_1, 0.6 * 5e6 - p.k * 1e-8, 1);
    EXPECT_GT(lost.friction, 0);
  }
}

// A broken joint carries neither tension nor shear when open.
TEST(Cohesive, OpenCrackCarriesNothing) {
  auto const p = make_cohesive_params(support::cohesive_input(true));
  CohesiveHistory h;
  h.kappa = 1, h.z = 0, h.f_s = 6e6;
  auto const t = at(p, h, {1e-5, 3e-5, -2e-5}, true);
  EXPECT_EQ(t.sigma, 0);
  EXPECT_EQ(t.tau_1, 0);
  EXPECT_EQ(t.tau_2, 0);
}

// A joint declared uncrackable is linear however far it opens, and keeps no history.
TEST(Cohesive, UncrackableIsLinear) {
  auto in = support::cohesive_input(true);
  in.crackable = false;
  auto const p = make_cohesive_params(in);
  CohesiveHistory h;
  auto const t = at(p, h, {1e-3, 2e-3, -1e-3});
  EXPECT_DOUBLE_EQ(t.sigma, 1.5e11);
  EXPECT_DOUBLE_EQ(t.tau_1, 3e11);
  EXPECT_DOUBLE_EQ(t.tau_2, -1.5e11);
  EXPECT_EQ(h.kappa, 0);
  EXPECT_DOUBLE_EQ(cohesive_stored(p, h, {1e-3, 0, 0}, false), 0.5 * 1.5e14 * 1e-6);
}

// The mode of a crack is read from what it dissipated.
TEST(Cohesive, ModeFromDissipation) {
  EXPECT_EQ(crack_mode({0, 0, 5}), CrackMode::none);
  EXPECT_EQ(crack_mode({90, 10, 0}), CrackMode::opening);
  EXPECT_EQ(crack_mode({10, 90, 500}), CrackMode::sliding);
  EXPECT_EQ(crack_mode({50, 50, 0}), CrackMode::mixed);
}

// A parameter outside its range is refused with its name.
TEST(Cohesive, BadParametersAreNamed) {
  auto refuse = [](auto change, char const* name) {
    auto in = support::cohesive_input(true);
    change(in);
    try {
      make_cohesive_params(in);
      FAIL() << name;
    } catch (fissura::core::Error const& e) {
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
    }
  };
  refuse([](auto& i) { i.p = 0; }, "penalty");
  refuse([](auto& i) { i.h = -1; }, "size h");
  refuse([](auto& i) { i.f_t = 0; }, "f_t");
  refuse([](auto& i) { i.G_f = 0; }, "G_f");
  refuse([](auto& i) { i.cohesion = 0; }, "cohesion");
  refuse([](auto& i) { i.friction_angle = 1.6; }, "angle");
  refuse([](auto& i) { i.friction = -0.1; }, "mu");
  refuse([](auto& i) { i.mohr_coulomb = false, i.f_s = 0; }, "f_s");
}
} // namespace
