#include "fissura/laws/steel_menegotto_pinto.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace {
using namespace fissura::laws;

SteelParams table_6() {
  return {190e9, 350e6, 540e6, 0.0165, 0.1, 0.12, SteelLaw::menegotto_pinto};
}

double go(SteelMenegottoPinto const& law, MenegottoPintoHistory& h, double to, int steps = 4000) {
  double const from = h.strain;
  double stress = 0;
  for (int i = 1; i <= steps; ++i) stress = law(h, from + (to - from) * i / steps);
  return stress;
}

// The virgin curve is elastic at first and follows f_y plus hardening to f_u at eps_u.
TEST(SteelMenegottoPinto, MonotonicCurve) {
  auto const p = table_6();
  SteelMenegottoPinto const law{p};
  MenegottoPintoHistory h;
  EXPECT_NEAR(go(law, h, 0.25 * p.eps_y()), 0.25 * p.f_y, 1);
  EXPECT_NEAR(go(law, h, 0.6 * p.eps_y()), 0.6 * p.f_y, 1e-4 * p.f_y);
  double const slope = (p.f_u - p.f_y) / (p.eps_u - p.eps_y());
  EXPECT_NEAR(go(law, h, 0.05), p.f_y + slope * (0.05 - p.eps_y()), 1e-3 * p.f_y);
  EXPECT_NEAR(go(law, h, p.eps_u), p.f_u, 1e-3 * p.f_u);
}

// Rupture at eps_br is final, and f_u is never passed on the way.
TEST(SteelMenegottoPinto, Rupture) {
  auto const p = table_6();
  SteelMenegottoPinto const law{p};
  MenegottoPintoHistory h;
  EXPECT_LE(go(law, h, 0.119), p.f_u);
  EXPECT_EQ(go(law, h, 0.121), 0);
  EXPECT_TRUE(h.ruptured);
  EXPECT_EQ(go(law, h, 0.0), 0);
}

// Unloading starts with the slope E_s and the Bauschinger effect rounds the way into compression.
TEST(SteelMenegottoPinto, UnloadingIsElasticThenRound) {
  auto const p = table_6();
  SteelMenegottoPinto const law{p};
  MenegottoPintoHistory h;
  double const top = go(law, h, 0.03);
  double const after = law(h, 0.03 - 1e-5);
  EXPECT_NEAR((top - after) / 1e-5, p.E_s, 0.01 * p.E_s);
  EXPECT_GT(go(law, h, 0.03 - 2 * p.eps_y()), top - 1.5 * p.f_y); // the elastic line would be at top - 2 f_y
  EXPECT_LT(go(law, h, 0.0), -0.9 * p.f_y);
}

// After a large reversal the bar comes back to its hardening line, which Kato's curve (4) does not reach.
TEST(SteelMenegottoPinto, ReachesTheEnvelopeAgain) {
  auto const p = table_6();
  SteelMenegottoPinto const law{p};
  MenegottoPintoHistory h;
  go(law, h, 0.03);
  go(law, h, 0.0);
  double const slope = (p.f_u - p.f_y) / (p.eps_u - p.eps_y());
  EXPECT_GT(go(law, h, 0.06), 0.95 * (p.f_y + slope * 0.06));
}

// Isotropic hardening: the compressive branch after a large tensile strain passes the one without shift.
TEST(SteelMenegottoPinto, IsotropicShift) {
  auto const p = table_6();
  SteelMenegottoPinto const law{p};
  MenegottoPintoHistory h;
  go(law, h, 0.04);
  law(h, 0.0399);
  EXPECT_NEAR(h.now.own_2, 0.01 * (0.04 / p.eps_y() - 7), 1e-9);
}
} // namespace
