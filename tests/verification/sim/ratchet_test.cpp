// A tie that is loaded past yield and let go: what stays must stay.
#include <gtest/gtest.h>

#include "fissura/sim/monitor.hpp"
#include "support/cases.hpp"

namespace fissura::support {
namespace {

/// A tie pulled by a force to 180 kN, past the yield of its bar (166 kN), and released; nothing holds its
/// right end.
model::Case released_tie(model::SteelLaw law) {
  auto c = tie_case({4, 1, 1}, 0.3, 0);
  c.motions.clear();
  c.bars[0] = straight_bar({0, 0.05, 0.05}, {0.6, 0.05, 0.05}, 0.02);
  c.bars[0].slip_reduction = model::SlipReduction::paper;
  c.bars[0].l_cr_from = model::CrackLength::given, c.bars[0].l_cr = 0.15;
  c.bars[0].place = {"case.toml", 25, 1};
  c.steels[0].law = law;
  for (double const from : {-0.01, 0.31}) { // it cracks in the middle alone
    model::JointRegionSpec sound;
    sound.place = {"case.toml", 28, 1};
    sound.where = box({from, -0.01, -0.01}, {from + 0.3, 0.11, 0.11});
    sound.crackable = false;
    c.joint_regions.push_back(sound);
  }
  model::ForceSpec pull;
  pull.place = {"case.toml", 30, 1};
  pull.name = "pull";
  pull.where = plane(0, 0.6);
  pull.direction = {1, 0, 0};
  pull.curve.kind = model::Curve::Kind::table;
  pull.curve.times = {0, 0.03, 0.06};
  pull.curve.values = {0, 180e3, 0};
  c.forces = {pull};
  c.run.mass_damping = 600;
  return c;
}

double mean_strain(Stepper const& x) {
  double sum = 0;
  int count = 0;
  for (int n = 0; n < node_count(x.m); ++n)
    if (std::abs(position(x.m, n).x - 0.6) < 1e-9) sum += at_node(x.s.u, n).x, ++count;
  return sum / count / 0.6;
}
void advance_to(Stepper& x, double time) {
  while (x.s.time < time) x.advance();
}

class Ratchet : public testing::TestWithParam<model::SteelLaw> {};

// Requirement: a cracked tie that has yielded keeps its mean strain to 1e-9 over 50 ms without load: no
// ratcheting.
TEST_P(Ratchet, none_without_load) {
  Stepper x(released_tie(GetParam()));
  double largest = 0;
  while (x.s.time < 0.06) x.advance(100), largest = std::max(largest, mean_strain(x));
  EXPECT_EQ(sim::count_bars(x.s.bars).yielded, 1);
  EXPECT_EQ(sim::count_bars(x.s.bars).broken, 0);
  EXPECT_LT(largest, 0.02);
  advance_to(x, 0.2);
  double const then = mean_strain(x);
  EXPECT_LT(then, largest);
  advance_to(x, 0.25);
  EXPECT_NEAR(mean_strain(x), then, 1e-9);
}

// Requirement: the same small cycle of load, repeated, does not lengthen the tie by more than 1e-6 a cycle.
// With Kato's steel it does not shorten it either; Menegotto-Pinto's round branches take back some 3 % of
// what stays (docs/theory/steel_menegotto_pinto.md), never more than 4 %.
TEST_P(Ratchet, small_under_repeated_load) {
  auto c = released_tie(GetParam());
  for (int i = 0; i < 4; ++i) {
    double const t = c.forces[0].curve.times.back();
    c.forces[0].curve.times.insert(c.forces[0].curve.times.end(), {t + 0.03, t + 0.06, t + 0.1});
    c.forces[0].curve.values.insert(c.forces[0].curve.values.end(), {100e3, 0, 0});
  }
  Stepper x(c);
  std::vector<double> rest;
  for (int i = 0; i < 5; ++i) {
    advance_to(x, 0.06 + 0.1 * i - (i == 0 ? 0 : 1e-4));
    rest.push_back(mean_strain(x));
  }
  double const taken_back = GetParam() == model::SteelLaw::kato ? 1e-6 : 0.04 * rest[1];
  for (std::size_t i = 2; i < rest.size(); ++i) {
    EXPECT_LE(rest[i], rest[i - 1] + 1e-6) << i;
    EXPECT_GE(rest[i], rest[i - 1] - taken_back) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(BothLaws, Ratchet,
                         testing::Values(model::SteelLaw::kato, model::SteelLaw::menegotto_pinto));

} // namespace
} // namespace fissura::support
