#include "fissura/model/record.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <numeric>

namespace fissura::model {

namespace {

using core::InputError;
using core::Place;

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
  double largest = 0;
  for (double const a : r.acceleration) largest = std::max(largest, std::abs(a));
  if (spec.pga > 0) {
    if (!(largest > 0))
      throw InputError(
          spec.place,
          fmt::format("the record \"{}\" is zero throughout and cannot be scaled to `pga`", spec.file));
    for (double& a : r.acceleration) a *= spec.pga / largest;
  }
  r.velocity = integral(r.times, r.acceleration);
  r.displacement.assign(r.times.size(), 0);
  for (std::size_t i = 1; i < r.times.size(); ++i) {
    double const dt = r.times[i] - r.times[i - 1];
    r.displacement[i] = r.displacement[i - 1] + dt * r.velocity[i - 1] +
                        dt * dt * (2 * r.acceleration[i - 1] + r.acceleration[i]) / 6;
  }
}

Record read_record(RecordSpec const& spec) {
  constexpr std::uintmax_t largest = 64U << 20U;
  namespace fs = std::filesystem;
  std::error_code ec;
  if (!fs::is_regular_file(spec.file, ec))
    throw InputError(spec.place, fmt::format("there is no record \"{}\"", spec.file));
  if (fs::file_size(spec.file, ec) > largest)
    throw InputError(Place{spec.file}, fmt::format("the record is larger than {} MiB", largest >> 20U));
  std::ifstream in(spec.file, std::ios::binary);
  std::string const text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in || in.bad())
    throw core::Error(core::Failure::io, fmt::format("cannot read the record \"{}\"", spec.file));
  auto r = parse_record(text, spec.file, spec);
  correct_and_integrate(r, spec);
  return r;
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
