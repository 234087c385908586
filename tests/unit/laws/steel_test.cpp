#include "fissura/laws/steel.hpp"

#include <gtest/gtest.h>

namespace {
using namespace fissura::laws;

// The law named in the parameters is the one that answers.
TEST(Steel, DispatchesByLaw) {
  SteelParams p{210e9, 530e6, 650e6, 0.03, 0.1, 0.12, SteelLaw::kato};
  SteelHistory h, g;
  EXPECT_EQ(steel_stress(p, h, 0.01), 530e6);
  EXPECT_EQ(last_stress(p, h), 530e6);
  p.law = SteelLaw::menegotto_pinto;
  EXPECT_GT(steel_stress(p, g, 0.01), 531e6); // no plateau
  EXPECT_EQ(last_stress(p, g), g.menegotto_pinto.stress);
  EXPECT_FALSE(is_ruptured(p, g));
  steel_stress(p, g, 0.13);
  EXPECT_TRUE(is_ruptured(p, g));
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
