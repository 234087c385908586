#include "fissura/step/lanczos.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include "fissura/parallel/parallel.hpp"

namespace fissura::step {

namespace {

constexpr std::size_t grain = 1 << 14;
/// Fewer may have converged to an eigenvalue below the largest.
constexpr int least_steps = 29;

double dot(std::span<float const> a, std::span<float const> b) {
  return parallel::sum_chunks<double>(a.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::array<double, 4> sum{}; // four at a time: one sum would wait for each addition
    for (std::size_t i = begin; i < end; ++i) sum[i % 4] += static_cast<double>(a[i]) * b[i];
    return sum[0] + sum[1] + (sum[2] + sum[3]);
  });
}

/// Largest eigenvalue of the tridiagonal matrix, and the last entry of its eigenvector.
struct Ritz {
  double value, last;
};
Ritz largest_of_tridiagonal(std::vector<double> const& diagonal, std::vector<double> const& beside) {
  auto const n = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<Eigen::VectorXd const>(diagonal.data(), n),
                                Eigen::Map<Eigen::VectorXd const>(beside.data(), n - 1));
  return {solver.eigenvalues()[n - 1], std::abs(solver.eigenvectors()(n - 1, n - 1))};
}

/// a = scale (a - share b)
void combine(std::span<float> a, double scale, double share, std::span<float const> b) {
  parallel::for_chunks(a.size(), grain, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) a[k] = static_cast<float>(scale * (a[k] - share * b[k]));
  });
}

} // namespace

double largest_eigenvalue(Product const& product, std::vector<float> start, double tolerance,
                          int most_steps) {
  std::vector<double> diagonal, beside;
  std::vector<float> now = std::move(start), other(now.size()); // other: the vector before, then the next
  combine(now, 1 / std::sqrt(dot(now, now)), 0, now);
  double beta = 0;
  for (int i = 0; i < most_steps; ++i) {
    product(now, beta, other);
    double const alpha = dot(now, other);
    diagonal.push_back(alpha);
    combine(other, 1, alpha, now);
    beta = std::sqrt(dot(other, other));
    bool const is_exhausted = !(beta > 1e-6 * std::abs(alpha)) || i + 1 == most_steps;
    if ((i % 5 == 4 && i >= least_steps) || is_exhausted) {
      Ritz const ritz = largest_of_tridiagonal(diagonal, beside);
      double const residual = beta * ritz.last; // some eigenvalue lies this near
      if (is_exhausted || residual < tolerance * ritz.value) return ritz.value + residual;
    }
    beside.push_back(beta);
    combine(other, 1 / beta, 0, other);
    std::swap(now, other);
  }
  return 0;
}

} // namespace fissura::step
