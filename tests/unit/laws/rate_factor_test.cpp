#include "fissura/laws/rate_factor.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fissura::laws {
namespace {

// Requirement: the factor is that of fib Model Code 2010 on both branches, 1 at static rates and below.
TEST(RateFactor, follows_the_model_code) {
  EXPECT_EQ(rate_factor_mc2010(0), 1);
  EXPECT_EQ(rate_factor_mc2010(1e-7), 1);
  EXPECT_NEAR(rate_factor_mc2010(1e-6), 1, 1e-15);
  EXPECT_NEAR(rate_factor_mc2010(1), std::pow(1e6, 0.018), 1e-12);
  EXPECT_NEAR(rate_factor_mc2010(1), 1.2823, 1e-4);
  EXPECT_NEAR(rate_factor_mc2010(100), 0.0062 * std::cbrt(1e8), 1e-12);
  EXPECT_NEAR(rate_factor_mc2010(100), 2.8778, 1e-4);
}

// Requirement: it never falls and never jumps, at the kink neither.
TEST(RateFactor, grows_without_jumps) {
  double before = 1;
  for (int i = 0; i <= 9000; ++i) {
    double const now = rate_factor_mc2010(std::pow(10, -6 + 1e-3 * i));
    EXPECT_GE(now, before);
    EXPECT_LE(now, before * 1.001);
    before = now;
  }
}

} // namespace
} // namespace fissura::laws
