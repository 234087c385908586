#include "fissura/loads/curve.hpp"

#include <algorithm>
#include <cmath>

namespace fissura::loads {

using model::Curve;

double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10 + x * (6 * x - 15));
}

namespace {

/// Cubic Hermite on the interval that ends with row i, x from 0 to 1.
double cubic(Curve const& c, std::size_t i, double x) {
  double const y = 1 - x, T = c.times[i] - c.times[i - 1];
  return y * y * ((1 + 2 * x) * c.values[i - 1] + x * T * c.slopes[i - 1]) +
         x * x * ((1 + 2 * y) * c.values[i] - y * T * c.slopes[i]);
}

double table_value(Curve const& c, double t) {
  auto const after = std::upper_bound(c.times.begin(), c.times.end(), t);
  if (after == c.times.begin()) return c.values.empty() ? 0 : c.values.front();
  if (after == c.times.end())
    return c.values.back() + (c.slopes.empty() ? 0 : c.slopes.back() * (t - c.times.back()));
  std::size_t const i = static_cast<std::size_t>(after - c.times.begin());
  double const x = (t - c.times[i - 1]) / (c.times[i] - c.times[i - 1]);
  if (!c.slopes.empty()) return cubic(c, i, x);
  return c.values[i - 1] + x * (c.values[i] - c.values[i - 1]);
}

/// Turning points 0, +a, -a, 0 (or 0, +a, 0) joined by smooth steps: no velocity jump at a reversal.
double cycle_value(Curve const& c, double t) {
  if (t / c.period >= static_cast<double>(c.peaks.size()) * std::max(1, c.repeats)) return 0;
  std::size_t const done = static_cast<std::size_t>(t / c.period);
  std::size_t const peak = done / static_cast<std::size_t>(std::max(1, c.repeats));
  if (peak >= c.peaks.size()) return 0;
  double const a = c.peaks[peak], x = t / c.period - static_cast<double>(done);
  if (c.one_sided) return a * (x < 0.5 ? smooth_step(2 * x) : 1 - smooth_step(2 * x - 1));
  if (x < 0.25) return a * smooth_step(4 * x);
  if (x < 0.75) return a * (1 - 2 * smooth_step(2 * (x - 0.25)));
  return a * (smooth_step(4 * (x - 0.75)) - 1);
}

} // namespace

double value_at(Curve const& c, double t) {
  if (t < 0) return 0;
  switch (c.kind) {
  case Curve::Kind::constant:
    return c.value;
  case Curve::Kind::ramp:
    return c.from + (c.value - c.from) * (c.over > 0 ? smooth_step(t / c.over) : 1);
  case Curve::Kind::table:
    return table_value(c, t);
  case Curve::Kind::cycles:
    return cycle_value(c, t);
  }
  return 0;
}

double length_of(Curve const& c) {
  switch (c.kind) {
  case Curve::Kind::constant:
    return 0;
  case Curve::Kind::ramp:
    return c.over;
  case Curve::Kind::table:
    return c.times.empty() ? 0 : c.times.back();
  case Curve::Kind::cycles:
    return c.period * std::max(1, c.repeats) * static_cast<double>(c.peaks.size());
  }
  return 0;
}

} // namespace fissura::loads
