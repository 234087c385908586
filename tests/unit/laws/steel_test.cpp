#include "fissura/laws/steel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {
using namespace fissura::laws;

// The law named in the parameters is the one that answers.
TEST(Steel, DispatchesByLaw) {
  SteelParams p{210e9, 530e6, 650e6, 0.03, 0.1, 0.12, SteelLaw::kato};
  SteelHistory h, g;
  EXPECT_EQ(steel_stress(p, h, 0.01), 530e6);
  p.law = SteelLaw::menegotto_pinto;
  EXPECT_GT(steel_stress(p, g, 0.01), 531e6); // no plateau
  EXPECT_FALSE(is_ruptured(p, g));
  steel_stress(p, g, 0.13);
  EXPECT_TRUE(is_ruptured(p, g));
}

// Requirement: a steel without hardening (f_u = f_y, the horizontal branch of EC2) is allowed, and stays
// within its yield stress through cycles, by either law.
TEST(Steel, MayBePerfectlyPlastic) {
  for (auto const law : {SteelLaw::kato, SteelLaw::menegotto_pinto}) {
    SteelParams const p{200e9, 500e6, 500e6, 0.03, 0.1, 0.12, law};
    EXPECT_NO_THROW(check_steel_params(p));
    SteelHistory h;
    double strain = 0, most = 0;
    for (double const target : {0.02, -0.01, 0.05, 0.03, 0.09})
      for (double const step = target > strain ? 1e-5 : -1e-5; (target - strain) * step > 0; strain += step)
        most = std::max(most, steel_stress(p, h, strain));
    EXPECT_GT(most, 0.99 * p.f_y);
    EXPECT_LE(most, p.f_y * (1 + 1e-9));
    EXPECT_FALSE(is_ruptured(p, h));
  }
}

// Shear in the bar reduces both strengths, not the stiffness (Eq. 24).
TEST(Steel, ReducedStrength) {
  SteelParams const p{210e9, 530e6, 650e6, 0.03, 0.1, 0.12, SteelLaw::kato};
  SteelHistory h;
  EXPECT_NEAR(steel_stress(p, h, 0.0005, 0.8), 105e6, 1);
  EXPECT_NEAR(steel_stress(p, h, 0.02, 0.8), 424e6, 1);
  EXPECT_NEAR(steel_stress(p, h, 0.1, 0.8), 520e6, 1);
}
} // namespace
