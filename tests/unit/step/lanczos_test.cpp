#include "fissura/step/lanczos.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace fissura::step {
namespace {

/// A chain of n masses: -x_(i-1) + 2 x_i - x_(i+1); its largest eigenvalue is 2 + 2 cos(pi/(n + 1)).
void chain(std::span<float const> in, double share, std::span<float> out) {
  for (std::size_t i = 0; i < in.size(); ++i) {
    double const product = 2. * in[i] - (i > 0 ? in[i - 1] : 0.) - (i + 1 < in.size() ? in[i + 1] : 0.);
    out[i] = static_cast<float>(product - share * out[i]);
  }
}

std::vector<float> start(std::size_t n) {
  std::vector<float> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = std::sin(1.0f + 37.0f * static_cast<float>(i * i % 101));
  return x;
}

// Requirement: small problems are solved to the rounding of single precision, since the iteration runs until
// it is exhausted.
TEST(Lanczos, solves_small_problems) {
  for (std::size_t const n : {1, 2, 7, 20}) {
    auto x = start(n);
    double const exact = 2 + 2 * std::cos(std::numbers::pi / static_cast<double>(n + 1));
    EXPECT_NEAR(largest_eigenvalue(chain, x, 1e-12, 100), exact, 1e-5) << n;
  }
}

// Requirement: on a large problem the value, residual included, is never below the eigenvalue by more than
// the tolerance and never above it by more than the residual that many products leave.
TEST(Lanczos, errs_on_the_safe_side_on_large_problems) {
  auto x = start(5000);
  double const value = largest_eigenvalue(chain, x, 0.002, 100);
  EXPECT_GE(value, 4 * (1 - 0.002));
  EXPECT_LE(value, 4 * 1.03);
}

} // namespace
} // namespace fissura::step
