// The verdict on inertia, on histories that are made up.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "fissura/sim/inertia.hpp"

namespace fissura::sim {
namespace {

constexpr double pi = std::numbers::pi;

/// A load that grows to 100 kN in a second, 2000 readings; `difference` of jacks and supports over the load
/// at a time, kinetic over internal energy.
template <class Difference, class Ratio> std::vector<Reading> readings(Difference difference, Ratio ratio) {
  std::vector<Reading> list;
  for (int i = 1; i <= 2000; ++i) {
    double const t = i / 2000.0, load = 1e5 * t;
    list.push_back({t, 100 * t * t * ratio(t), 100 * t * t, {0, 0, load * difference(t)}, load});
  }
  return list;
}
double quiet(double /*t*/) {
  return 0.01;
}
double ringing(double t, double period) {
  return std::sin(2 * pi * t / period);
}

// Requirement: a difference of jack and support forces that rings around zero is no inertia, however large,
// and its period is found.
TEST(Inertia, does_not_count_a_vibration) {
  auto const found = judge_inertia(readings([](double t) { return 0.3 * ringing(t, 0.02); }, quiet));
  EXPECT_NEAR(found.period, 0.02, 0.001);
  EXPECT_LT(found.imbalance, 0.01);
  EXPECT_TRUE(found.is_quasi_static());
}

// Requirement: of two vibrations, one above the other, the longer one is found too; neither is inertia.
TEST(Inertia, finds_the_longest_vibration) {
  auto const found = judge_inertia(
      readings([](double t) { return 0.2 * ringing(t, 0.05) + 0.2 * ringing(t, 0.004); }, quiet));
  EXPECT_NEAR(found.period, 0.05, 0.005);
  EXPECT_LT(found.imbalance, 0.02);
}

// Requirement: noise of zero mean is no inertia.
TEST(Inertia, does_not_count_noise) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.2);
  auto const found = judge_inertia(readings([&](double) { return noise(random); }, quiet));
  EXPECT_LT(found.imbalance, 0.05);
  EXPECT_TRUE(found.is_quasi_static());
}

// Requirement: a true offset of 10 % between jacks and supports is inertia, with a vibration on top of it or
// without; one of 2 % is not.
TEST(Inertia, counts_an_offset) {
  for (double const swing : {0.0, 0.02, 0.3}) {
    auto const offset = [&](double size) {
      return judge_inertia(readings([&](double t) { return size + swing * ringing(t, 0.02); }, quiet));
    };
    EXPECT_NEAR(offset(0.10).imbalance, 0.10, 0.005) << swing;
    EXPECT_FALSE(offset(0.10).is_quasi_static()) << swing;
    EXPECT_NEAR(offset(0.02).imbalance, 0.02, 0.005) << swing;
    EXPECT_TRUE(offset(0.02).is_quasi_static()) << swing;
  }
}

// Requirement: inertia that swings as slowly as the loading is inertia, although its mean is zero.
TEST(Inertia, counts_what_swings_with_the_load) {
  auto const found = judge_inertia(readings([](double t) { return 0.12 * ringing(t, 0.25); }, quiet));
  EXPECT_GT(found.imbalance, 0.06);
  EXPECT_FALSE(found.is_quasi_static());
}

// Requirement: shocks in the kinetic energy that are short beside the vibration do not count; a fifth of the
// run with 10 % of kinetic energy does.
TEST(Inertia, counts_kinetic_energy_that_stays) {
  auto const rings = [](double t) { return 0.02 * ringing(t, 0.02); };
  auto const shocks = [](double t) { return std::fmod(t, 0.02) < 0.0024 ? 0.2 : 0.01; };
  EXPECT_TRUE(judge_inertia(readings(rings, shocks)).is_quasi_static());
  auto const moving = judge_inertia(readings(rings, [](double t) { return t > 0.8 ? 0.1 : 0.01; }));
  EXPECT_NEAR(moving.quiet_share, 0.78, 0.03); // of the readings with more than 1 % of the largest energy
  EXPECT_FALSE(moving.is_quasi_static());
}

// Requirement: no readings, one, and two at the same time are judged without a fault.
TEST(Inertia, of_hardly_anything) {
  EXPECT_EQ(judge_inertia({}).imbalance, 0);
  Reading const one{1, 0.1, 1, {1, 0, 0}, 10};
  EXPECT_NEAR(judge_inertia({one}).imbalance, 0.1, 1e-12);
  EXPECT_NEAR(judge_inertia({one, one}).imbalance, 0.1, 1e-12);
}

} // namespace
} // namespace fissura::sim
