#include "fissura/step/highest_frequency.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "fissura/concrete/concrete.hpp"
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
  Tangent(Model const& m, bool bars_activated) : m_(m), s_(make_state(m)), w_(make_scratch(m, s_)) {
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
    auto const& b = m_.bonding;
    for (std::size_t c = 0; c + 1 < b.start.size(); ++c)
      for (int i = b.start[c]; i < b.start[c + 1]; ++i)
        per_unknown_[static_cast<std::size_t>(b.node[static_cast<std::size_t>(i)])] *=
            std::sqrt(static_cast<float>(b.start[c + 1] - b.start[c]));
  }

  /// One value for bonded copies.
  void constrain(std::span<float> x) const {
    auto const& b = m_.bonding;
    for (std::size_t c = 0; c + 1 < b.start.size(); ++c)
      for (int r = 0; r < 3; ++r) {
        auto at = [&](int i) -> float& {
          return x[axes * static_cast<std::size_t>(b.node[static_cast<std::size_t>(i)]) +
                   static_cast<std::size_t>(r)];
        };
        double mean = 0;
        for (int i = b.start[c]; i < b.start[c + 1]; ++i) mean += at(i) / (b.start[c + 1] - b.start[c]);
        for (int i = b.start[c]; i < b.start[c + 1]; ++i) at(i) = static_cast<float>(mean);
      }
  }

  /// out = -M^-1/2 (change of the forces under the trial motion `field` along in)/size - share out.
  void apply(std::span<float const> in, double share, std::span<float> out, core::NodeField& field,
             double length) {
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
        to = static_cast<float>(-per_unknown_[first + i / axes] * inverse * change - share * to);
      }
    });
    std::fill(field.values.begin(), field.values.end(), 0.0);
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
  std::vector<double> at_rest_;    ///< empty where there are no forces at rest
  std::vector<float> per_unknown_; ///< per node
};

} // namespace

HighestFrequency highest_frequency(Model const& m) {
  HighestFrequency highest;
  for (bool const activated : {false, true}) {
    if (activated && m.bars.joints.empty()) continue;
    Tangent tangent(m, activated);
    highest.omega_2 = std::max(highest.omega_2, tangent.largest(false));
    if (!activated && m.tets.any_viscosity) highest.viscous = tangent.largest(true);
  }
  return highest;
}

} // namespace fissura::step
