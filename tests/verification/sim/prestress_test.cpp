// Requirement: the energy that prestressed bars hold at t = 0 counts as put in, so the balance closes from
// the start.
#include <gtest/gtest.h>

#include <cmath>

#include "support/cases.hpp"

namespace fissura {
namespace {

TEST(Prestress, starts_with_a_closed_balance) {
  auto c = support::tie_case({4, 1, 1}, 1e-2, 0.0);
  c.bars[0].initial_strain = 1e-3;
  support::Stepper x(c);
  step::EnergyBalance e;
  step::advance(x.m, x.s, x.w, &e);
  EXPECT_GT(e.start, 0);
  EXPECT_NEAR(e.missing(), 0, 1e-9 * e.start);
  for (int i = 0; i < 500; ++i) step::advance(x.m, x.s, x.w);
  step::advance(x.m, x.s, x.w, &e);
  EXPECT_LT(std::abs(e.missing()), 5e-3 * e.start);
}

} // namespace
} // namespace fissura
