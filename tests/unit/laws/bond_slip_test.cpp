#include "fissura/laws/bond_slip.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <utility>

#include "fissura/core/error.hpp"

namespace {
using namespace fissura::laws;

SteelParams table_4() {
  return {210e9, 530e6, 650e6, 0.03, 0.1, 0.12, SteelLaw::kato};
}
SteelParams table_6() {
  return {190e9, 350e6, 540e6, 0.0165, 0.1, 0.12, SteelLaw::kato};
}

/// A diameter that makes the normalised slip equal to the slip in metres.
BondParams unit_scale(SteelParams const& steel, double f_c, double alpha = 1) {
  return make_bond_params({std::cbrt(std::pow(f_c / 20e6, 2)), f_c, alpha}, steel);
}

// Eq. 26 as corrected: the straight branch up to l_cr = 4.4 D, the exponential beyond.
TEST(BondSlip, ReductionByTheNextCrack) {
  for (auto [ratio, alpha] : {std::pair{1.0, 0.087},
                              {2.0, 0.174},
                              {4.0, 0.348},
                              {4.43, 0.3854},
                              {5.0, 0.4297},
                              {6.0, 0.5059},
                              {8.0, 0.654},
                              {10.0, 0.7815},
                              {15.0, 0.9596},
                              {20.0, 0.9971}})
    EXPECT_NEAR(slip_reduction(ratio), alpha, 5.1e-5) << ratio;
}

// The constants of the curve for the steels of Tables 4 and 6.
TEST(BondSlip, ConstantsOfTheCurve) {
  auto const p = make_bond_params({0.025, 30e6, 1}, table_4());
  EXPECT_NEAR(p.normalise * 0.025, 1.3103706971044482, 1e-12);
  auto const c = bond_curve(p, 1, 0);
  EXPECT_NEAR(c.eps_y, 0.0025238095238, 1e-12);
  EXPECT_NEAR(c.s_y, 0.027341269841, 1e-11);
  EXPECT_NEAR(c.H1, 5.64, 1e-10);
  EXPECT_NEAR(c.H2, 0.84, 1e-10);
  EXPECT_NEAR(c.eps_0, 0.059698310948, 1e-11);
  EXPECT_NEAR(c.s_0 - c.ramp, 0.194839743590, 1e-10);
  auto const q = make_bond_params({0.019, 29e6, 1}, table_6());
  EXPECT_NEAR(q.normalise * 0.019, 1.281087129802762, 1e-12);
  auto const d = bond_curve(q, 1, 0);
  EXPECT_NEAR(d.s_y, 0.015560941828, 1e-11);
  EXPECT_NEAR(d.eps_0, 0.037641509752, 1e-11);
  EXPECT_NEAR(d.s_0 - d.ramp, 0.204354623908, 1e-10);
}

// Up to yield the strain is linear in the slip and starts at the stress of activation; yield comes at s_y.
TEST(BondSlip, ElasticLine) {
  auto const p = unit_scale(table_4(), 30e6);
  BondHistory h;
  h.sigma_cr = 21e6;
  EXPECT_NEAR(bond_strain(p, h, 0, 1), 1e-4, 1e-15);
  EXPECT_NEAR(bond_strain(p, h, -0.001, 1), 1e-4 - 0.001 / (2 + 3500 * 530.0 / 210e3), 1e-12);
  double const s_y = 0.0273412698 * (1 - 21.0 / 530);
  EXPECT_NEAR(bond_strain(p, h, s_y, 1), 530.0 / 210e3, 1e-10);
  EXPECT_FALSE(h.yielded);
  EXPECT_GT(bond_strain(p, h, 1.002 * s_y, 1), 0.03);
  EXPECT_TRUE(h.yielded);
}

// After yield: slopes 1/H1 up to eps_0 and 1/H2 beyond.
TEST(BondSlip, AfterYield) {
  auto const p = unit_scale(table_4(), 30e6);
  BondHistory h;
  double const shift = 0.0273412698 * 1e-3;
  EXPECT_NEAR(bond_strain(p, h, 0.0273412698 + shift + 0.1, 1), 0.03 + 0.1 / 5.64, 1e-9);
  EXPECT_NEAR(bond_strain(p, h, 0.1948397436 + shift + 0.01, 1), 0.0596983109 + 0.01 / 0.84, 1e-9);
}

// Unloading after yield follows Eqs. 21, 22 with beta = 1, and reloading comes back to the monotonic curve.
TEST(BondSlip, UnloadingAfterYield) {
  auto const p = unit_scale(table_4(), 30e6);
  BondHistory h;
  double const s_y = 0.02734126984, s_max = 0.1;
  double const eps_max = bond_strain(p, h, s_max, 1);
  double const eps = bond_strain(p, h, 0.08, 1);
  double const s_pl = (2 * eps + 0.03 - eps_max) / (eps_max + 0.03) * (s_max - s_y);
  double const s_pl_max = s_max - s_y;
  double const k_e = 2 + 3500 * 530.0 / 210e3;
  EXPECT_NEAR(s_max - 0.08, k_e * (eps_max - eps) + s_pl_max - s_pl, 1e-9);
  EXPECT_DOUBLE_EQ(bond_strain(p, h, s_max, 1), eps_max);
  EXPECT_GT(bond_strain(p, h, 0.101, 1), eps_max);
}

// The curve is recomputed only when shear changes the strength; a weaker bar yields at a smaller slip, and
// its elastic line stays the same, or energy would appear from nothing.
TEST(BondSlip, ReducedStrength) {
  auto const p = unit_scale(table_4(), 30e6);
  BondHistory h;
  double const strain = bond_strain(p, h, 0.01, 1);
  EXPECT_EQ(bond_strain(p, h, 0.01, 0.9), strain);
  EXPECT_EQ(h.curve.strength, 0.9);
  EXPECT_NEAR(h.curve.s_y, 0.9 * 0.02734126984, 1e-9);
  EXPECT_NEAR(h.curve.H1, 0.9 * 5.64, 1e-9);
  EXPECT_GT(bond_strain(p, h, 0.026, 0.9), 0.03);
}

// Shear that weakens a yielded bar changes its further slopes, not its strain: a jump would stretch the steel
// for nothing.
TEST(BondSlip, WeakeningAfterYieldIsContinuous) {
  auto const p = unit_scale(table_4(), 30e6);
  BondHistory h;
  double const before = bond_strain(p, h, 0.1, 1);
  EXPECT_EQ(bond_strain(p, h, 0.1, 0.8), before);
  EXPECT_NEAR(bond_strain(p, h, 0.11, 0.8), before + 0.01 / (0.8 * 5.64), 1e-9);
}

// A bar that shear weakens below the stress it had when the crack opened yields without a jump of its strain,
// with a plateau and without.
TEST(BondSlip, YieldOfABarWeakenedBelowItsStressAtCrackingIsContinuous) {
  for (auto law : {SteelLaw::kato, SteelLaw::menegotto_pinto}) {
    auto steel = table_4();
    steel.law = law;
    auto const p = unit_scale(steel, 30e6);
    BondHistory h;
    h.sigma_cr = 0.2 * steel.f_y;
    double const s_y = bond_curve(p, 0.1, h.sigma_cr).s_y, before = bond_strain(p, h, s_y, 0.1);
    EXPECT_GT(before, 0.2 * steel.eps_y());
    double const after = bond_strain(p, h, s_y + 1e-12, 0.1);
    EXPECT_TRUE(h.yielded);
    EXPECT_NEAR(after, before, 1e-7) << int(law);
    EXPECT_GT(bond_strain(p, h, s_y + 1e-3, 0.1), after);
  }
}

// A tie with one crack per element yields at the mean strain 0.087 s(eps_y)/K_fc = 1.815e-3 for every element
// size, as long as alpha is linear: the reason why the average curve does not depend on the mesh.
TEST(BondSlip, MeanStrainAtYieldOfACrackedTie) {
  double const D = 0.03385137501;
  for (double spacing : {0.3, 0.15, 0.1, 0.075}) {
    double const l_cr = spacing / 2;
    auto const p = make_bond_params({D, 30e6, slip_reduction(l_cr / D)}, table_4());
    double const S = bond_curve(p, 1, 0).s_y / p.normalise;
    EXPECT_NEAR(2 * S / spacing, 1.8152e-3, (spacing > 0.2 ? 4e-6 : 1e-7)) << spacing;
  }
}

// Parameters outside their range are refused by name.
TEST(BondSlip, BadParametersAreNamed) {
  auto refuse = [](BondInput in, char const* name) {
    try {
      make_bond_params(in, table_4());
      FAIL() << name;
    } catch (fissura::core::Error const& e) {
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
    }
  };
  refuse({0, 30e6, 1}, "diameter");
  refuse({0.01, 0, 1}, "f_c");
  refuse({0.01, 30e6, 0}, "alpha");
}
} // namespace
