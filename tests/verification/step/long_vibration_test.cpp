// Free elastic vibration for a very long time: 10^4 steps here, 10^6 in `make properties` (FISSURA_STEPS).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "fissura/concrete/concrete.hpp"
#include "fissura/step/stable_step.hpp"
#include "support/reinforced_model.hpp"

namespace fissura::support {
namespace {

long steps_wanted() {
  char const* const wanted = std::getenv("FISSURA_STEPS");
  long const n = wanted ? std::atol(wanted) : 0;
  return n > 0 ? n : 10000;
}

/// One step with a reading of the energy held, relative to `start` if that is not 0. Central differences keep
/// another energy than H = T + V: its mean over time is that of H + m |dv|^2/24, dv being the change of a
/// velocity in a step (backward error analysis: H + dt^2 (v.V''v/12 - m a^2/24); in the mean v.V''v = m a^2).
/// So H itself creeps by (omega dt)^2/24 of whatever energy wanders from slow modes to fast ones, and comes
/// to rest once all have their share.
double read(model::Model const& m, state::State& s, state::Scratch& w, double start) {
  std::vector<double> const before(s.v.values.begin(), s.v.values.end());
  step::EnergyBalance e;
  step::advance(m, s, w, &e);
  double lag = 0;
  for (int n = 0; n < node_count(m); ++n) {
    Vec3 const dv = at_node(s.v, n) - Vec3{before[3 * n], before[3 * n + 1], before[3 * n + 2]};
    lag += m.mass[n] * dot(dv, dv) / 24;
  }
  double const held = e.held() + lag;
  return start > 0 ? held / start - 1 : held;
}

/// Energy held, as its relative departure from the first reading, averaged over spans of equal length.
std::vector<double> vibrate(model::Model const& m, state::State& s, long steps, int spans) {
  auto w = step::make_scratch(m, s);
  double const start = read(m, s, w, 0);
  std::vector<double> mean(static_cast<std::size_t>(spans), 0);
  int const every = 7; // no multiple of a period
  long const readings = std::max(1L, steps / spans / every);
  for (auto& x : mean)
    for (long i = 0; i < readings; ++i) {
      for (int k = 1; k < every; ++k) step::advance(m, s, w);
      x += read(m, s, w, start) / static_cast<double>(readings);
    }
  return mean;
}

struct Line {
  double change = 0, noise = 0; ///< over the whole length, and the standard error of that
};
/// Straight line through equally spaced values. Its standard error counts that neighbours are alike, as they
/// are where energy wanders slowly between modes: n values with the correlation r are worth n (1 - r)/(1 +
/// r).
Line fit(std::vector<double> const& y) {
  double const n = static_cast<double>(y.size()), middle = (n - 1) / 2;
  double sum = 0, square = 0, slope = 0, rest = 0, alike = 0, before = 0;
  for (double const v : y) sum += v / n;
  for (std::size_t i = 0; i < y.size(); ++i) {
    double const x = static_cast<double>(i) - middle;
    square += x * x, slope += x * y[i];
  }
  slope /= square;
  for (std::size_t i = 0; i < y.size(); ++i) {
    double const r = y[i] - sum - slope * (static_cast<double>(i) - middle);
    rest += r * r, alike += i > 0 ? r * before : 0;
    before = r;
  }
  double const correlation = rest > 0 ? std::clamp(alike / rest, 0.0, 0.9) : 0;
  return {slope * n, std::sqrt(rest / (n - 2) / square * (1 + correlation) / (1 - correlation)) * n};
}

/// A small block of random tets with a bar, shaken and let go; everything stays elastic.
void expect_no_drift(char const* name, bool with_bar) {
  Vec3 const size{0.2, 0.1, 0.1};
  std::vector<model::BarSpec> bars;
  if (with_bar) bars = {straight_bar({0, 0.04, 0.055}, {size.x, 0.05, 0.06}, 0.012)};
  auto m = reinforced_model(random_box_mesh(31, {2, 1, 1}, size), plain_concrete(), bars);
  m.dt = 0.65 * step::stable_step(m).dt;
  auto s = step::make_state(m);
  set_field(m, s.v, [&](Vec3 X) {
    double const x = X.x / size.x;
    return Vec3{0.02 * std::cos(3.14 * x), 0.01 * std::cos(6.28 * x), 0.005 * std::cos(3.14 * x)};
  });
  long const steps = steps_wanted();
  auto const mean = vibrate(m, s, steps, 40);
  EXPECT_EQ(concrete::count_joints(m, s).damaged, 0);
  double most = mean[0], least = mean[0];
  for (double const x : mean) most = std::max(most, x), least = std::min(least, x);
  Line const line = fit({mean.begin() + 20, mean.end()});
  EXPECT_LE(most - least, 1e-4) << name;
  EXPECT_LE(std::abs(line.change), 4 * line.noise + 1e-9) << name;
  std::printf("%s, %ld steps: means of 40 spans within %.2e; last half: change %.2e +- %.2e\n", name, steps,
              most - least, line.change, line.noise);
}

// Requirement: a drift of half the scatter of neighbouring spans is told from a slow wandering to and fro.
TEST(LongVibration, a_drift_would_be_seen) {
  std::vector<double> drifting, wandering;
  for (int i = 0; i < 20; ++i) {
    double const scatter = (i * 7919 % 13 - 6) / 6.0;
    drifting.push_back(0.5 * i + scatter);
    wandering.push_back(std::sin(0.5 * i) + 0.1 * scatter);
  }
  Line const drift = fit(drifting), none = fit(wandering);
  EXPECT_GT(drift.change, 4 * drift.noise);
  EXPECT_LT(std::abs(none.change), 4 * none.noise);
}

// Requirement: the energy of a free vibration does not drift by more than 1e-4, and over the last half of the
// time it has no trend: a line fitted to it rises or falls by no more than four standard errors.
TEST(LongVibration, of_a_jointed_block_has_no_drift) {
  expect_no_drift("jointed block", false);
}

// Requirement: the same with a bar through uncracked joints.
TEST(LongVibration, of_a_reinforced_block_has_no_drift) {
  expect_no_drift("reinforced block", true);
}

} // namespace
} // namespace fissura::support
