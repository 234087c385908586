// Requirement: the energy that prestressed bars hold at t = 0 counts as put in, so the balance closes from
// the start.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

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

// Requirement: a bar that is prestressed close to its yield strain and then yields in its cracks books its
// energy: the balance stays closed within 0.3 % of all that was put in.
TEST(Prestress, books_the_energy_of_a_bar_that_yields) {
  for (double const share : {0.5, 0.9, 0.99}) {
    auto c = support::tie_case({4, 1, 1}, 1e-2, 1.0);
    c.bars[0].initial_strain = share * c.steels[0].f_y / c.steels[0].E_s;
    support::Stepper x(c);
    step::EnergyBalance e;
    double worst = 0;
    auto const yields = [&] {
      for (std::size_t i = 0; i < x.s.bars.history.size(); ++i)
        if (x.s.bars.has_yielded(i)) return true;
      return false;
    };
    for (int reading = 0; reading < 60; ++reading) {
      x.advance(200);
      step::advance(x.m, x.s, x.w, &e);
      worst = std::max(worst, std::abs(e.missing()) / (e.start + e.absolute_work));
    }
    EXPECT_TRUE(yields()) << share;
    EXPECT_GT(e.bond_steel, 0) << share;
    EXPECT_LE(worst, 3e-3) << share << " " << e.missing();
    RecordProperty("residual_" + std::to_string(share), std::to_string(worst));
  }
}

} // namespace
} // namespace fissura
