#include "fissura/model/record.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <numeric>
#include <utility>

#include "fissura/model/series.hpp"

namespace fissura::model {

namespace {

using core::InputError;

constexpr double gravity = 9.80665; ///< g [m/s2]

double largest(std::vector<double> const& values) {
  double most = 0;
  for (double const v : values) most = std::max(most, std::abs(v));
  return most;
}

/// The unit that a header names against that of the deck.
void compare_unit(std::string const& header, std::string const& name, RecordSpec const& spec,
                  std::vector<std::string>& warnings) {
  double const named = header == "g"       ? gravity
                       : header == "cm/s2" ? 0.01
                       : header == "mm/s2" ? 0.001
                       : header == "m/s2"  ? 1
                                           : spec.unit;
  if (std::abs(named / spec.unit - 1) > 0.01)
    warnings.push_back(
        fmt::format("{}: the header names the unit {}, `unit` of the deck is {:.6g} m/s2: one of "
                    "them is wrong",
                    name, header, spec.unit));
}

std::vector<double> integral(std::vector<double> const& times, std::vector<double> const& rate) {
  std::vector<double> sum(rate.size(), 0);
  for (std::size_t i = 1; i < rate.size(); ++i)
    sum[i] = sum[i - 1] + 0.5 * (times[i] - times[i - 1]) * (rate[i - 1] + rate[i]);
  return sum;
}

double inner(std::vector<double> const& times, std::vector<double> const& a, std::vector<double> const& b) {
  std::vector<double> product(a.size());
  std::transform(a.begin(), a.end(), b.begin(), product.begin(), std::multiplies<>());
  return integral(times, product).back();
}

/// Gaussian elimination with row pivoting, in place; the system is small and regular.
std::vector<double> solve(std::vector<std::vector<double>> a, std::vector<double> b) {
  std::size_t const n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]), std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      double const factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

/// Least squares of v - sum c_k w_k under the condition that it vanishes at the end; w_k is the velocity of
/// the acceleration (t/T)^k as the record's rows see it.
void remove_baseline(Record& r, int degree) {
  std::size_t const n = static_cast<std::size_t>(degree) + 1;
  double const T = r.times.back();
  auto const v = integral(r.times, r.acceleration);
  double const scale = inner(r.times, v, v);
  if (!(scale > 0)) return;
  std::vector<std::vector<double>> a(n), w(n);
  for (std::size_t k = 0; k < n; ++k) {
    for (double const t : r.times) a[k].push_back(std::pow(t / T, static_cast<double>(k)));
    w[k] = integral(r.times, a[k]);
  }
  std::vector<std::vector<double>> matrix(n + 1, std::vector<double>(n + 1, 0));
  std::vector<double> right(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) matrix[i][j] = inner(r.times, w[i], w[j]) / (T * T * T);
    matrix[i][n] = matrix[n][i] = w[i].back() / T;
    right[i] = inner(r.times, w[i], v) / (T * T * T);
  }
  right[n] = v.back() / T;
  auto const c = solve(std::move(matrix), std::move(right));
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < r.times.size(); ++i) r.acceleration[i] -= c[k] * a[k][i];
}

} // namespace

void correct_and_integrate(Record& r, RecordSpec const& spec) {
  using Baseline = RecordSpec::Baseline;
  if (spec.baseline != Baseline::none)
    remove_baseline(r, spec.baseline == Baseline::mean ? 0 : spec.baseline == Baseline::linear ? 1 : 2);
  double const peak = largest(r.acceleration);
  if (spec.pga > 0) {
    if (!(peak > 0))
      throw InputError(
          spec.place,
          fmt::format("the record \"{}\" is zero throughout and cannot be scaled to `pga`", spec.file));
    for (double& a : r.acceleration) a *= spec.pga / peak;
  }
  r.velocity = integral(r.times, r.acceleration);
  r.displacement.assign(r.times.size(), 0);
  for (std::size_t i = 1; i < r.times.size(); ++i) {
    double const dt = r.times[i] - r.times[i - 1];
    r.displacement[i] = r.displacement[i - 1] + dt * r.velocity[i - 1] +
                        dt * dt * (2 * r.acceleration[i - 1] + r.acceleration[i]) / 6;
  }
}

Record parse_record(std::string_view text, std::string const& name, RecordSpec const& spec) {
  SeriesFormat format;
  format.what = "record", format.value = "an acceleration";
  format.time_column = spec.time_column, format.value_column = spec.acceleration_column;
  format.time_step = spec.time_step, format.as_header_says = spec.as_header_says;
  format.unit = spec.unit;
  auto series = parse_series(text, name, format);
  double const begin = series.times.front();
  for (double& t : series.times) t -= begin;
  Record r;
  r.times = std::move(series.times), r.acceleration = std::move(series.values);
  r.notes = std::move(series.notes), r.warnings = std::move(series.warnings);
  compare_unit(series.header.unit, name, spec, r.warnings);
  return r;
}

Record read_record(RecordSpec const& spec) {
  std::error_code ec;
  if (!std::filesystem::is_regular_file(spec.file, ec))
    throw InputError(spec.place, fmt::format("there is no record \"{}\"", spec.file));
  auto r = parse_record(read_series_text(spec.file, "record"), spec.file, spec);
  correct_and_integrate(r, spec);
  return r;
}

std::string describe(Record const& r) {
  double const pga = largest(r.acceleration);
  return fmt::format(
      "{}; PGA {:.4f} g ({:.4g} m/s2), largest velocity {:.4g} m/s, largest displacement {:.4g} "
      "m; it ends with {:.3g} m/s at {:.4g} m",
      extent_of(r.times), pga / gravity, pga, largest(r.velocity), largest(r.displacement), r.velocity.back(),
      r.displacement.back());
}

std::vector<std::string> doubts(Record const& r) {
  constexpr double most_g = 3, most_metres = 2, leads_by = 10;
  std::vector<std::string> found;
  double const pga = largest(r.acceleration);
  if (pga > most_g * gravity)
    found.push_back(fmt::format("its PGA is {:.4g} g; hardly a quake has more than {} g: is `unit` right?",
                                pga / gravity, most_g));
  double const moved = largest(r.displacement);
  if (moved > most_metres)
    found.push_back(
        fmt::format("the base moves by {:.4g} m: are `unit` and the step right, and does it need a "
                    "`baseline`?",
                    moved));
  double rest = 0;
  for (std::size_t i = 1; i < r.acceleration.size(); ++i) rest = std::max(rest, std::abs(r.acceleration[i]));
  if (r.acceleration.size() > 3 && rest > 0 && std::abs(r.acceleration.front()) > leads_by * rest)
    found.push_back(fmt::format("its first value, {:.4g} m/s2, is {:.3g} times the largest of the others: a "
                                "header that was read as a value? Begin that line with #",
                                r.acceleration.front(), std::abs(r.acceleration.front()) / rest));
  return found;
}

Curve displacement_curve(Record const& r, double start) {
  Curve c;
  c.kind = Curve::Kind::table;
  c.times = r.times;
  for (double& t : c.times) t += start;
  c.values = r.displacement;
  c.slopes = r.velocity;
  return c;
}

} // namespace fissura::model
