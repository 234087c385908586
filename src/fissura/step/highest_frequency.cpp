#include "fissura/step/highest_frequency.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "fissura/concrete/concrete.hpp"
#include "fissura/motion/points.hpp"
#include "fissura/parallel/parallel.hpp"
#include "fissura/rebar/rebar.hpp"
#include "fissura/step/advance.hpp"
#include "fissura/step/lanczos.hpp"

namespace fissura::step {

using model::Model;
using state::State;

namespace {

constexpr std::size_t axes = core::per_node;
constexpr double tolerance = 0.002;
/// On large meshes the residual, which counts as part of the frequency, falls slowly and a product is dear.
constexpr int most_products = 100, most_products_on_large = 40, large = 50'000;
/// Displacements [m] and velocities [m/s] of the trial motions: far below what any joint can break at, and
/// since they start from rest rounding does no harm.
constexpr double trial = 1e-10, trial_velocity = 1e-4;

/// The forces of a model as an operator on its degrees of freedom.
class Tangent {
 public:
  Tangent(Model const& m, bool bars_activated, Copies copies)
      : m_(m), s_(make_state(m)), w_(make_scratch(m, s_)), tied_(copies == Copies::tied) {
    if (bars_activated) rebar::activate_all(m, s_.bars);
    if (!m.initial_velocity.empty()) std::fill(s_.v.values.begin(), s_.v.values.end(), 0.0);
    keep_forces_at_rest();
    weigh_unknowns();
  }

  double largest(bool of_viscosity) {
    std::vector<float> start(s_.u.values.size());
    unsigned x = 1;
    for (float& value : start)
      value = static_cast<float>((x = x * 1664525u + 1013904223u) / 4294967296.0 - 0.5);
    constrain(start);
    return largest_eigenvalue(
        [&](auto in, double share, auto out) {
          of_viscosity ? apply(in, share, out, s_.v, trial_velocity) : apply(in, share, out, s_.u, trial);
        },
        std::move(start), tolerance, m_.tets.count > large ? most_products_on_large : most_products);
  }

 private:
  /// Motion per unknown: the root of copies over the cluster's mass makes the norm of the unknowns the
  /// energy.
  void weigh_unknowns() {
    per_unknown_.resize(s_.u.nodes());
    for (std::size_t n = 0; n < per_unknown_.size(); ++n)
      per_unknown_[n] =
          static_cast<float>(std::sqrt(m_.tets.inverse_mass[model::at(n / 4, static_cast<int>(n % 4), 4)]));
    if (m_.points.any()) return weigh_points();
    auto const& b = m_.bonding;
    for (std::size_t c = 0; c + 1 < b.start.size(); ++c)
      for (int i = b.start[c]; i < b.start[c + 1]; ++i)
        per_unknown_[static_cast<std::size_t>(b.node[static_cast<std::size_t>(i)])] *=
            std::sqrt(static_cast<float>(b.start[c + 1] - b.start[c]));
  }

  /// The mass matrix of a point is D^1/2 (1 - w w^T) D^1/2, D = m + mu, w = D^-1/2 mu/sum(mu)^1/2. So
  /// (1 + gamma w w^T) D^-1/2, gamma = ((1 - |w|^2)^-1/2 - 1)/|w|^2, brings it to unity.
  void weigh_points() {
    auto const& p = m_.points;
    tie_.assign(per_unknown_.size(), 0), gamma_.assign(p.count(), 0);
    auto const nodes = [&](std::size_t c) { return p.start[c + 1] - p.start[c]; };
    for (std::size_t i = 0; i < p.count(); ++i) {
      auto const first = static_cast<std::size_t>(p.first[i]), end = static_cast<std::size_t>(p.first[i + 1]);
      double mu = 0, mass = 0, left = 0; // left: 1 - |w|^2, without cancellation
      for (std::size_t c = first; c < end; ++c) {
        auto const& row = w_.points.row[c];
        mu += row.mu, mass += w_.points.mass[c], left += row.beta * w_.points.mass[c];
      }
      if (mu > 0) left /= mu, gamma_[i] = (1 / std::sqrt(left) - 1) / (1 - left);
      for (std::size_t c = first; c < end; ++c) {
        auto const& row = w_.points.row[c];
        for (int k = p.start[c]; k < p.start[c + 1]; ++k) {
          auto const node = static_cast<std::size_t>(p.node[static_cast<std::size_t>(k)]);
          per_unknown_[node] = static_cast<float>(
              std::sqrt(tied_ ? (p.start[end] - p.start[first]) / mass : nodes(c) * row.inverse));
          if (mu > 0) tie_[node] = row.mu * std::sqrt(row.inverse / (mu * nodes(c)));
        }
      }
    }
  }

  /// Lets the copies of each point answer for each other: x <- (1 + gamma w w^T) x.
  void couple(std::span<float> x) const {
    auto const& p = m_.points;
    if (!p.any() || tied_) return;
    for (std::size_t i = 0; i < p.count(); ++i)
      for (std::size_t r = 0; r < axes; ++r) {
        double sum = 0;
        int const from = p.start[static_cast<std::size_t>(p.first[i])],
                  to = p.start[static_cast<std::size_t>(p.first[i + 1])];
        auto const node = [&](int k) {
          return static_cast<std::size_t>(p.node[static_cast<std::size_t>(k)]);
        };
        for (int k = from; k < to; ++k) sum += tie_[node(k)] * x[axes * node(k) + r];
        for (int k = from; k < to; ++k)
          x[axes * node(k) + r] += static_cast<float>(gamma_[i] * sum * tie_[node(k)]);
      }
  }

  /// One value for copies that move as one.
  void constrain(std::span<float> x) const {
    auto const& p = m_.points;
    if (!p.any()) return constrain(x, m_.bonding.start, m_.bonding.node);
    if (!tied_) return constrain(x, p.start, p.node);
    std::vector<int> start;
    for (int const c : p.first) start.push_back(p.start[static_cast<std::size_t>(c)]);
    constrain(x, start, p.node);
  }
  static void constrain(std::span<float> x, std::vector<int> const& start, std::vector<int> const& node) {
    for (std::size_t c = 0; c + 1 < start.size(); ++c)
      for (int r = 0; r < 3; ++r) {
        auto at = [&](int i) -> float& {
          return x[axes * static_cast<std::size_t>(node[static_cast<std::size_t>(i)]) +
                   static_cast<std::size_t>(r)];
        };
        double mean = 0;
        for (int i = start[c]; i < start[c + 1]; ++i) mean += at(i) / (start[c + 1] - start[c]);
        for (int i = start[c]; i < start[c + 1]; ++i) at(i) = static_cast<float>(mean);
      }
  }

  /// out = -M^-1/2 (change of the forces under the trial motion `field` along in)/size - share out.
  void apply(std::span<float const> in, double share, std::span<float> out, core::NodeField& field,
             double length) {
    if (!gamma_.empty() && !tied_) {
      coupled_.assign(in.begin(), in.end()), couple(coupled_);
      in = coupled_;
      change_.resize(in.size());
    }
    double largest = 0;
    for (std::size_t i = 0; i < in.size(); ++i)
      largest = std::max<double>(largest, per_unknown_[i / axes] * std::abs(in[i]));
    double const size = length / largest, inverse = 1 / size;
    parallel::for_chunks(per_unknown_.size(), 4096, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n)
        for (std::size_t i = axes * n; i < axes * (n + 1); ++i)
          field.values[i] = size * per_unknown_[n] * in[i];
    });
    forces([&](std::size_t first, std::span<double const> force) {
      for (std::size_t i = 0; i < force.size(); ++i) {
        double const change = force[i] - (at_rest_.empty() ? 0 : at_rest_[axes * first + i]);
        float& to = out[axes * first + i];
        if (!change_.empty())
          change_[axes * first + i] = static_cast<float>(-per_unknown_[first + i / axes] * inverse * change);
        else
          to = static_cast<float>(-per_unknown_[first + i / axes] * inverse * change - share * to);
      }
    });
    std::fill(field.values.begin(), field.values.end(), 0.0);
    if (!change_.empty()) {
      constrain(change_), couple(change_);
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(change_[i] - share * out[i]);
    }
    constrain(out);
  }

  /// Of bars under prestress.
  void keep_forces_at_rest() {
    std::atomic<bool> any = false;
    forces([&](std::size_t, std::span<double const> force) {
      if (std::any_of(force.begin(), force.end(), [](double f) { return f != 0; })) any = true;
    });
    if (!any) return;
    at_rest_.resize(s_.u.values.size());
    forces([&](std::size_t first, std::span<double const> force) {
      std::copy(force.begin(), force.end(), at_rest_.begin() + static_cast<std::ptrdiff_t>(axes * first));
    });
  }

  void forces(concrete::TakeForces const& take) {
    concrete::joint_forces(m_, s_, w_);
    rebar::bar_joint_forces(m_, s_, w_, rebar::SlipBy::positions);
    rebar::bar_forces(m_, s_, w_);
    w_.overlay.clear();
    rebar::gather_bar_forces(m_, w_);
    concrete::corner_forces(m_, s_, w_, take);
  }

  Model const& m_;
  State s_;
  state::Scratch w_;
  std::vector<double> at_rest_;         ///< empty where there are no forces at rest
  std::vector<float> per_unknown_;      ///< per node
  bool tied_;                           ///< the copies of a point move as one
  std::vector<double> tie_, gamma_;     ///< with joint inertia: w per node (of its cluster), gamma per point
  std::vector<float> coupled_, change_; ///< with joint inertia
};

} // namespace

HighestFrequency highest_frequency(Model const& m, Copies copies) {
  HighestFrequency highest;
  for (bool const activated : {false, true}) {
    if (activated && (m.bars.joints.empty() || copies == Copies::tied)) continue;
    Tangent tangent(m, activated, copies);
    highest.omega_2 = std::max(highest.omega_2, tangent.largest(false));
    if (!activated && m.tets.any_viscosity) highest.viscous = tangent.largest(true);
  }
  return highest;
}

} // namespace fissura::step
