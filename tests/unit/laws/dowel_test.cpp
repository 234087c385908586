#include "fissura/laws/dowel.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace {
using namespace fissura::laws;

DowelParams bar(double D, double E_s, double bars = 1) {
  return make_dowel_params({D, bars * std::numbers::pi * D * D / 4, E_s, 530e6, 30e6});
}

// The length of the bent zone of two bars in concrete of 30 MPa.
TEST(Dowel, LengthOfTheBentZone) {
  EXPECT_NEAR(bar(0.016, 200e9).L_c0, 73.60969339e-3, 1e-9);
  EXPECT_NEAR(bar(0.03385, 210e9).L_c0, 157.64166889e-3, 1e-9);
}

// Dowel forces at S = 0.2 mm and growing offset (Eq. 23): the bent zone lengthens as the concrete beside it
// is crushed.
TEST(Dowel, Forces) {
  auto const p = bar(0.016, 200e9);
  DowelHistory h;
  EXPECT_NEAR(dowel_force(p, h, 0.2e-3, 0.1e-3), 5631, 0.6);
  EXPECT_DOUBLE_EQ(h.softening, 1);
  EXPECT_NEAR(dowel_force(p, h, 0.2e-3, 0.5e-3), 11273, 0.6);
  EXPECT_NEAR(dowel_force(p, h, 0.2e-3, 1e-3), 11638, 0.6);
  EXPECT_NEAR(dowel_force(p, h, 0.2e-3, 3e-3), 7902, 0.6);
  auto const q = bar(0.03385, 210e9);
  DowelHistory g;
  EXPECT_NEAR(dowel_force(q, g, 0.2e-3, 1e-3), 68298, 0.6);
  EXPECT_NEAR(dowel_force(q, g, 0.2e-3, 3e-3), 80877, 0.6);
}

// Shear stress lowers the yield stress by von Mises (Eq. 24); neither it nor the damage recovers.
TEST(Dowel, StrengthNeverRecovers) {
  auto const p = bar(0.016, 200e9);
  DowelHistory h;
  double const tau = dowel_force(p, h, 0.2e-3, 1e-3) / p.A_s;
  double const expected = std::sqrt(1 - 3 * std::pow(tau / 530e6, 2));
  EXPECT_NEAR(h.strength, expected, 1e-12);
  DowelHistory const before = h;
  EXPECT_EQ(dowel_force(p, h, 0, 0), 0);
  EXPECT_EQ(h.strength, before.strength);
  EXPECT_EQ(h.softening, before.softening);
  EXPECT_NEAR(dowel_force(p, h, 0, 0.5e-3), 0.5 * tau * p.A_s, 1e-6); // secant
}

// A closing crack (S < 0) does not heal or stiffen the dowel.
TEST(Dowel, NegativeSlipCountsAsZero) {
  auto const p = bar(0.016, 200e9);
  DowelHistory h, g;
  EXPECT_DOUBLE_EQ(dowel_force(p, h, -1e-3, 0.5e-3), dowel_force(p, g, 0, 0.5e-3));
  EXPECT_EQ(h.DI, g.DI);
}

// An area of several bars acts as so many dowels, each with the same shear stress.
TEST(Dowel, SeveralBarsInOne) {
  auto const one = bar(0.012, 210e9), four = bar(0.012, 210e9, 4);
  DowelHistory h, g;
  EXPECT_NEAR(dowel_force(four, g, 1e-4, 2e-4), 4 * dowel_force(one, h, 1e-4, 2e-4), 1e-6);
  EXPECT_NEAR(g.strength, h.strength, 1e-15);
}
} // namespace
