#pragma once
// The true stability limit of a model at rest: the largest eigenvalue of its linear tangent, without
// assembling it. The product of the tangent with a vector is a central difference of the step's own forces at
// tiny displacements; the largest eigenvalue comes from Lanczos iteration (a power iteration that keeps what
// it has seen).
#include <algorithm>
#include <cmath>

#include "fissura/concrete/concrete.hpp"
#include "support/corner_forces.hpp"
#include "support/reinforced_model.hpp"

namespace fissura::support {

class Tangent {
 public:
  explicit Tangent(model::Model const& m, bool bars_activated)
      : m_(m), s_(step::make_state(m)), w_(step::make_scratch(m, s_)),
        size_(static_cast<std::size_t>(3 * node_count(m))) {
    if (bars_activated) activate_bars(m, s_);
  }

  /// Largest step [s] of the central differences: 4 = largest eigenvalue of M^-1 (dt^2 K + 2 dt C), C the
  /// viscous matrix, whose forces lag half a step. Without viscosity 2/omega_max.
  double stable_step() {
    double const stiff = largest(1, 0);
    double dt = 2 / std::sqrt(stiff);
    if (!m_.tets.any_viscosity) return dt;
    double low = 0, high = dt;
    for (int i = 0; i < 40; ++i) {
      dt = 0.5 * (low + high);
      (largest(dt * dt, 2 * dt) > 4 ? high : low) = dt;
      if (high - low < 1e-7 * high) break;
    }
    return dt;
  }

  /// Largest eigenvalue of M^-1 (k K + c C).
  double largest(double k, double c) {
    std::vector<double> diagonal, beside, previous(size_, 0), now(size_), product(size_);
    Random random(7);
    for (double& x : now) x = random.uniform(-1, 1);
    average_over_clusters(now);
    scale(now, 1 / std::sqrt(dot(now, now)));
    double beta = 0, last = 0;
    for (int i = 0; i < 300; ++i) {
      apply(now, k, c, product);
      double const alpha = dot(now, product);
      diagonal.push_back(alpha);
      if (i % 10 == 9) {
        double const value = largest_of_tridiagonal(diagonal, beside);
        if (std::abs(value - last) < 1e-8 * value) return value;
        last = value;
      }
      for (std::size_t j = 0; j < size_; ++j) product[j] -= alpha * now[j] + beta * previous[j];
      beta = std::sqrt(dot(product, product));
      if (beta < 1e-12 * alpha) break;
      beside.push_back(beta);
      scale(product, 1 / beta);
      previous = now;
      std::swap(now, product);
    }
    return largest_of_tridiagonal(diagonal, beside);
  }

 private:
  static double dot(std::vector<double> const& a, std::vector<double> const& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }
  static void scale(std::vector<double>& a, double f) {
    for (double& x : a) x *= f;
  }

  double inverse_mass(std::size_t node) const {
    return m_.tets.inverse_mass[model::at(node / 4, node % 4, 4)];
  }

  void average_over_clusters(std::vector<double>& x) const {
    if (!m_.bonding.any) return;
    for (std::size_t c = 0; c + 1 < m_.bonding.start.size(); ++c) {
      int const from = m_.bonding.start[c], to = m_.bonding.start[c + 1];
      for (int r = 0; r < 3; ++r) {
        double mean = 0;
        for (int i = from; i < to; ++i) mean += x[3 * m_.bonding.node[i] + r] / (to - from);
        for (int i = from; i < to; ++i) x[3 * m_.bonding.node[i] + r] = mean;
      }
    }
  }
  int copies(std::size_t node) const {
    if (!m_.bonding.any) return 1;
    if (copies_.empty()) {
      copies_.assign(size_ / 3, 1);
      for (std::size_t c = 0; c + 1 < m_.bonding.start.size(); ++c)
        for (int i = m_.bonding.start[c]; i < m_.bonding.start[c + 1]; ++i)
          copies_[m_.bonding.node[i]] = m_.bonding.start[c + 1] - m_.bonding.start[c];
    }
    return copies_[node];
  }

  /// Displacement per unknown: the root of copies over the cluster's mass makes the norm of the unknowns the
  /// energy.
  double per_unknown(std::size_t n) const { return std::sqrt(inverse_mass(n) * copies(n)); }

  /// y = M^-1/2 (k K + c C) M^-1/2 x on the space in which bonded copies move alike; k > 0.
  void apply(std::vector<double> const& x, double k, double c, std::vector<double>& y) {
    double largest_u = 0;
    for (std::size_t n = 0; 3 * n < size_; ++n) {
      double const f = per_unknown(n);
      for (std::size_t r = 0; r < 3; ++r) largest_u = std::max(largest_u, std::abs(f * x[3 * n + r]));
    }
    double const step =
        1e-7 / largest_u; // [m]: strains far below any nonlinearity, forces far above rounding
    std::fill(y.begin(), y.end(), 0.0);
    for (double const sign : {1.0, -1.0}) {
      forces(x, sign * step, c / k);
      for (std::size_t n = 0; 3 * n < size_; ++n) {
        double const f = per_unknown(n);
        for (std::size_t r = 0; r < 3; ++r) y[3 * n + r] -= sign * 0.5 * k / step * f * force_(n, r);
      }
    }
    average_over_clusters(y);
  }

  /// Corner forces at the motion u of size `step` along x and at v = c_over_k u.
  void forces(std::vector<double> const& x, double step, double c_over_k) {
    for (std::size_t n = 0; 3 * n < size_; ++n) {
      double const f = per_unknown(n);
      for (std::size_t r = 0; r < 3; ++r) {
        s_.u(n, r) = f * step * x[3 * n + r];
        s_.v(n, r) = c_over_k * s_.u(n, r);
      }
    }
    concrete::joint_forces(m_, s_, w_);
    rebar::bar_joint_forces(m_, s_, w_, rebar::SlipBy::positions);
    rebar::bar_forces(m_, s_, w_);
    w_.overlay.clear();
    rebar::gather_bar_forces(m_, w_);
    corner_forces(m_, s_, w_, 0, force_);
  }

  /// Largest eigenvalue of a symmetric tridiagonal matrix by bisection with Sturm sequences.
  static double largest_of_tridiagonal(std::vector<double> const& a, std::vector<double> const& b) {
    double low = a[0], high = a[0];
    for (std::size_t i = 0; i < a.size(); ++i) {
      double const left = i > 0 ? std::abs(b[i - 1]) : 0, right = i + 1 < a.size() ? std::abs(b[i]) : 0;
      high = std::max(high, a[i] + left + right);
      low = std::max(low, a[i]);
    }
    while (high - low > 1e-12 * high) {
      double const x = 0.5 * (low + high);
      if (x <= low || x >= high) break;
      bool all_below = true;
      double q = a[0] - x;
      for (std::size_t i = 0; i < a.size() && all_below; ++i) {
        if (i > 0) q = a[i] - x - b[i - 1] * b[i - 1] / q;
        if (q >= 0) all_below = false;
      }
      (all_below ? high : low) = x;
    }
    return high;
  }

  model::Model const& m_;
  state::State s_;
  state::Scratch w_;
  std::size_t size_;
  core::NodeField force_;
  mutable std::vector<int> copies_;
};

} // namespace fissura::support
