#include <gtest/gtest.h>

#include <cmath>

#include "fissura/loads/curve.hpp"
#include "fissura/loads/loads.hpp"

namespace fissura::loads {
namespace {

using model::Curve;

Curve constant(double value) {
  Curve c;
  c.value = value;
  return c;
}
Curve ramp(double value, double over) {
  Curve c;
  c.kind = Curve::Kind::ramp, c.value = value, c.over = over;
  return c;
}
Curve table(std::vector<double> times, std::vector<double> values) {
  Curve c;
  c.kind = Curve::Kind::table, c.times = std::move(times), c.values = std::move(values);
  return c;
}
Curve cycles(std::vector<double> peaks, double period, int repeats, bool one_sided) {
  Curve c;
  c.kind = Curve::Kind::cycles, c.peaks = std::move(peaks), c.period = period, c.repeats = repeats,
  c.one_sided = one_sided;
  return c;
}

/// Largest jump of the velocity between neighbouring steps, and the largest velocity, from t = 0 to `end`.
struct Velocity {
  double jump = 0, largest = 0;
};
Velocity velocity_of(Curve const& c, double end) {
  int const steps = 20000;
  double const dt = end / steps;
  Velocity r;
  double before = 0;
  for (int i = 0; i < steps; ++i) {
    double const now = (value_at(c, (i + 1) * dt) - value_at(c, i * dt)) / dt;
    r.jump = std::max(r.jump, std::abs(now - before));
    r.largest = std::max(r.largest, std::abs(now));
    before = now;
  }
  return r;
}

// Requirement: the smooth step rises from 0 to 1 with zero slope and curvature at both ends.
TEST(SmoothStep, is_flat_at_both_ends) {
  EXPECT_EQ(smooth_step(-1), 0);
  EXPECT_EQ(smooth_step(0), 0);
  EXPECT_EQ(smooth_step(1), 1);
  EXPECT_EQ(smooth_step(2), 1);
  EXPECT_DOUBLE_EQ(smooth_step(0.5), 0.5);
  double const h = 1e-3;
  EXPECT_LT(smooth_step(h), 11 * h * h * h); // 10 x^3: no slope, no curvature
  EXPECT_LT(1 - smooth_step(1 - h), 11 * h * h * h);
}

// Requirement: every curve is 0 before its start and keeps its last value afterwards.
TEST(Curves, are_zero_before_and_constant_after) {
  EXPECT_EQ(value_at(constant(3), -1e-9), 0);
  EXPECT_EQ(value_at(constant(3), 0), 3);
  EXPECT_EQ(value_at(constant(3), 99), 3);
  EXPECT_EQ(value_at(ramp(3, 2), -1), 0);
  EXPECT_DOUBLE_EQ(value_at(ramp(3, 2), 1), 1.5);
  EXPECT_EQ(value_at(ramp(3, 2), 99), 3);
  EXPECT_EQ(value_at(ramp(3, 0), 0), 3);
  EXPECT_EQ(value_at(table({0, 1, 3}, {0, 2, -2}), -1), 0);
  EXPECT_EQ(value_at(table({0, 1, 3}, {0, 2, -2}), 99), -2);
  EXPECT_EQ(value_at(cycles({1, 2}, 1, 1, false), 99), 0);
}

// Requirement: a table is linear between its points and hits each of them.
TEST(Curves, tables_are_linear_between_points) {
  auto const c = table({0, 1, 3}, {0, 2, -2});
  EXPECT_DOUBLE_EQ(value_at(c, 0.25), 0.5);
  EXPECT_DOUBLE_EQ(value_at(c, 1), 2);
  EXPECT_DOUBLE_EQ(value_at(c, 2), 0);
  EXPECT_DOUBLE_EQ(value_at(c, 3), -2);
}

// Requirement: cycles visit each peak +, -, `repeats` times (or + only), and return to 0.
TEST(Curves, cycles_visit_their_peaks) {
  auto const both = cycles({1, 3}, 4, 2, false);
  for (int i = 0; i < 4; ++i) {
    double const a = i < 2 ? 1 : 3, t = 4.0 * i;
    EXPECT_NEAR(value_at(both, t), 0, 1e-14);
    EXPECT_NEAR(value_at(both, t + 1), a, 1e-14);
    EXPECT_NEAR(value_at(both, t + 2), 0, 1e-14);
    EXPECT_NEAR(value_at(both, t + 3), -a, 1e-14);
  }
  EXPECT_EQ(length_of(both), 16);
  auto const one = cycles({2}, 4, 1, true);
  EXPECT_NEAR(value_at(one, 2), 2, 1e-14);
  EXPECT_NEAR(value_at(one, 4), 0, 1e-14);
  for (double t = 0; t <= 4; t += 0.1) EXPECT_GE(value_at(one, t), 0);
}

// Requirement: ramps and cycles never jump in velocity, neither at the start nor at a reversal nor at the
// end.
TEST(Curves, ramps_and_cycles_have_no_velocity_jump) {
  for (auto const& c : {ramp(2, 1), cycles({1, 2, 0.5}, 0.3, 2, false), cycles({1, 2}, 0.4, 1, true)}) {
    auto const v = velocity_of(c, 2.5);
    EXPECT_GT(v.largest, 1);
    EXPECT_LT(v.jump, 0.01 * v.largest);
  }
}

// Requirement: a curve bound to a stage runs from the moment that stage began, and is 0 before.
TEST(TimedCurves, run_from_the_start_of_their_stage) {
  state::State s;
  s.stage_start = {0, 0};
  model::TimedCurve const c{ramp(2, 1), 1};
  EXPECT_EQ(value_at(c, s, 5), 0);
  s.stage = 1;
  s.stage_start[1] = 5;
  EXPECT_EQ(value_at(c, s, 5), 0);
  EXPECT_DOUBLE_EQ(value_at(c, s, 5.5), 1);
  EXPECT_EQ(value_at({ramp(2, 1), -1}, s, 7), 2);
}

// Requirement: a table with slopes is cubic between its rows, meets values and slopes there without a jump,
// and runs on straight beyond its end.
TEST(Curve, with_slopes_is_cubic) {
  auto c = table({1, 2, 4}, {0, 1, 19});
  c.slopes = {0, 3, 3}; // (t - 1)^3, then 1 + 3 x + 9 x^2 - ... with the same slope at both ends
  EXPECT_EQ(value_at(c, 0.5), 0);
  for (double const x : {0.0, 0.25, 0.5, 1.0}) EXPECT_NEAR(value_at(c, 1 + x), x * x * x, 1e-15);
  for (double const t : {2.0, 4.0})
    EXPECT_NEAR((value_at(c, t + 1e-6) - value_at(c, t - 1e-6)) / 2e-6, 3, 1e-4) << t;
  EXPECT_DOUBLE_EQ(value_at(c, 6), 25);
}

} // namespace
} // namespace fissura::loads
