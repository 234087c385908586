#include "fissura/sim/inertia.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace fissura::sim {

namespace {

using Series = std::vector<double>;

/// Vibrations with fewer periods than this in the run are taken for the loading itself.
constexpr double least_periods = 10;
/// A quarter of the values lies beyond the swing; a crossing counts once the other side has been reached by
/// half of that.
constexpr double quantile_of_swing = 0.75, hysteresis = 0.5;
constexpr int most_vibrations = 6;      ///< one above the other
constexpr double clearly_longer = 1.25; ///< than the one smoothed away before
constexpr std::size_t least_seen = 3;   ///< periods that make a vibration

double swing_of(Series values) {
  for (double& v : values) v = std::abs(v);
  auto const at = values.begin() +
                  static_cast<std::ptrdiff_t>(quantile_of_swing * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Times between crossings from below to above zero.
Series periods_between_crossings(Series const& time, Series const& values) {
  double const threshold = hysteresis * swing_of(values);
  Series periods;
  double last = -1;
  bool below = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] < -threshold) below = true;
    if (!below || values[i] < threshold) continue;
    below = false;
    if (last >= 0) periods.push_back(time[i] - last);
    last = time[i];
  }
  return periods;
}

/// The period in which half of the vibrating time is spent; 0 where nothing vibrates.
double visible_period(Series const& time, Series const& values) {
  Series periods = periods_between_crossings(time, values);
  double const longest = (time.back() - time.front()) / least_periods;
  std::erase_if(periods, [&](double p) { return p > longest; });
  if (periods.size() < least_seen) return 0;
  std::sort(periods.begin(), periods.end());
  double total = 0, passed = 0;
  for (double const p : periods) total += p;
  for (double const p : periods)
    if ((passed += p) >= 0.5 * total) return p;
  return 0;
}

/// Means over `window` seconds around each reading; at the ends over the first and the last of them.
Series smoothed(Series const& time, Series const& values, double window) {
  std::size_t const n = time.size();
  Series area(n, 0);
  for (std::size_t i = 1; i < n; ++i)
    area[i] = area[i - 1] + 0.5 * (values[i] + values[i - 1]) * (time[i] - time[i - 1]);
  auto const area_at = [&](double t) {
    auto const after = std::upper_bound(time.begin() + 1, time.end() - 1, t) - time.begin();
    auto const i = static_cast<std::size_t>(after) - 1;
    double const step = time[i + 1] - time[i], share = step > 0 ? (t - time[i]) / step : 0;
    double const value = values[i] + share * (values[i + 1] - values[i]);
    return area[i] + 0.5 * (values[i] + value) * (t - time[i]);
  };
  Series means(n);
  for (std::size_t i = 0; i < n; ++i) {
    double const begin = std::clamp(time[i] - window / 2, time.front(), time.back() - window);
    means[i] = (area_at(begin + window) - area_at(begin)) / window;
  }
  return means;
}

double mean_size(Series const& x) {
  double sum = 0;
  for (double const v : x) sum += std::abs(v);
  return sum / static_cast<double>(x.size());
}

struct Columns {
  Series time, kinetic, internal, forces;
  std::array<Series, 3> resultant;

  explicit Columns(std::vector<Reading> const& readings) {
    for (auto const& r : readings) {
      if (!time.empty() && r.time <= time.back()) continue; // a row and a beat of the ledger in one step
      time.push_back(r.time), kinetic.push_back(r.kinetic), internal.push_back(r.internal);
      forces.push_back(r.forces);
      for (int k = 0; k < 3; ++k) resultant[static_cast<std::size_t>(k)].push_back(r.resultant[k]);
    }
  }
};

/// The longest vibration of the direction that swings most: shorter ones are smoothed away, one after the
/// other, until what is left does not vibrate.
double longest_vibration(Columns const& c) {
  auto const most =
      std::max_element(c.resultant.begin(), c.resultant.end(),
                       [&](auto const& a, auto const& b) { return mean_size(a) < mean_size(b); });
  double period = 0;
  for (int i = 0; i < most_vibrations; ++i) {
    double const next = visible_period(c.time, period > 0 ? smoothed(c.time, *most, period) : *most);
    if (next <= clearly_longer * period) break;
    period = next;
  }
  return period;
}

/// Seconds that each reading stands for: half way to its neighbours. What output settings add counts no more.
Series weights_of(Series const& time) {
  std::size_t const n = time.size();
  if (n < 2) return Series(n, 1);
  Series weights(n);
  for (std::size_t i = 0; i < n; ++i)
    weights[i] = 0.5 * (time[std::min(i + 1, n - 1)] - time[i > 0 ? i - 1 : 0]);
  return weights;
}

/// Share of the time, internal energy above 1 % of its largest value, in which kinetic energy is small, at
/// the moment or as a mean over the vibration: a shock is short, and a mean would carry a collapse far ahead
/// of it.
double share_of_quiet(Columns const& c, Series const& weights, double period) {
  auto const [kinetic, internal] =
      period > 0 ? std::pair{smoothed(c.time, c.kinetic, period), smoothed(c.time, c.internal, period)}
                 : std::pair{c.kinetic, c.internal};
  double const largest = *std::max_element(c.internal.begin(), c.internal.end());
  double quiet = 0, counted = 0;
  for (std::size_t i = 0; i < c.time.size(); ++i) {
    if (!(c.internal[i] > 0.01 * largest)) continue;
    counted += weights[i];
    if (c.kinetic[i] < quiet_ratio * c.internal[i] || kinetic[i] < quiet_ratio * internal[i])
      quiet += weights[i];
  }
  return counted > 0 ? quiet / counted : 0;
}

double imbalance_of(Columns const& c, Series const& weights, double period) {
  std::array<Series, 3> left = c.resultant;
  if (period > 0)
    for (Series& axis : left) axis = smoothed(c.time, axis, period);
  double missing = 0, forces = 0;
  for (std::size_t i = 0; i < c.time.size(); ++i) {
    missing += weights[i] * norm(Vec3{left[0][i], left[1][i], left[2][i]});
    forces += weights[i] * c.forces[i];
  }
  return forces > 0 ? missing / forces : 0;
}

} // namespace

Inertia judge_inertia(std::vector<Reading> const& readings) {
  Inertia found;
  Columns const c(readings);
  if (c.time.empty()) return found;
  if (c.time.size() > 2) found.period = longest_vibration(c);
  Series const weights = weights_of(c.time);
  found.quiet_share = share_of_quiet(c, weights, found.period);
  found.imbalance = imbalance_of(c, weights, found.period);
  return found;
}

} // namespace fissura::sim
