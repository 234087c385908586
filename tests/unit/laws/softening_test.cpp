#include "fissura/laws/softening.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace {
using fissura::laws::softening;

// The curve starts at full strength with zero slope and ends at nothing.
TEST(Softening, EndsOfTheCurve) {
  EXPECT_DOUBLE_EQ(softening(0.0), 1);
  EXPECT_DOUBLE_EQ(softening(1.0), 0);
  EXPECT_DOUBLE_EQ(softening(-0.1), 1);
  EXPECT_DOUBLE_EQ(softening(1.5), 0);
  EXPECT_NEAR((softening(1e-5) - 1) / 1e-5, 0, 2e-4);
  EXPECT_NEAR(softening(1e-12), 1, 1e-11);
}

// A crack never regains strength as damage grows.
TEST(Softening, FallsEverywhere) {
  for (int i = 0; i < 1000; ++i) EXPECT_LT(softening((i + 1) / 1000.0), softening(i / 1000.0)) << i;
}

// The dissipated energy of a joint rests on this integral, so it must be right to twelve digits.
TEST(Softening, Integral) {
  int const n = 2000; // Simpson
  double sum = softening(0.0) + softening(1.0);
  for (int i = 1; i < n; ++i) sum += (i % 2 ? 4 : 2) * softening(double(i) / n);
  EXPECT_NEAR(sum / (3.0 * n), fissura::laws::softening_integral, 1e-12);
}

// The exponential of its own is right to 2e-15 over the range it is used in.
TEST(Softening, ItsExponential) {
  for (int i = 0; i <= 330; ++i) {
    double const x = -0.01 * i;
    EXPECT_NEAR(fissura::laws::exp_of_small_negative(x) / std::exp(x), 1, 2e-15) << x;
  }
}

// The literal formula of Eq. 15, with powers, agrees with the products.
TEST(Softening, LiteralFormula) {
  double const D = 0.37, a = 0.63, b = 1.8, c = 6;
  double const z = (1 - (a + b - 1) / (a + b) * std::exp(D * (a + c * b) / ((a + b) * (1 - a - b)))) *
                   (a * (1 - D) + b * std::pow(1 - D, c));
  EXPECT_NEAR(softening(D), z, 1e-15);
}
} // namespace
