#include "fissura/step/joint_inertia.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <vector>

#include "fissura/model/make_blocks.hpp"
#include "fissura/motion/points.hpp"
#include "fissura/rebar/rebar.hpp"
#include "fissura/step/highest_frequency.hpp"
#include "fissura/step/tet_bound.hpp"

namespace fissura::step {

using model::Model;

namespace {

/// A tet alone: omega^2 [1/s2] and mass [kg].
struct LooseTet {
  double omega_2 = 0, mass = 0;
};
std::vector<LooseTet> loose_tets(Model const& m) {
  std::vector<LooseTet> all(static_cast<std::size_t>(m.tets.count));
  for (std::size_t t = 0; t < all.size(); ++t) {
    double const* const mass = m.mass.data() + 4 * t;
    all[t] = {elastic_bound(m, t, {mass[0], mass[1], mass[2], mass[3]}),
              mass[0] + mass[1] + mass[2] + mass[3]};
  }
  return all;
}

/// The lowest rate >= `least` at which lifting all faster tets to it adds no more than a share of the mass.
double rate_for_loose_tets(std::vector<LooseTet> tets, double least) {
  constexpr double most_added = 0.01;
  std::sort(tets.begin(), tets.end(), [](auto const& a, auto const& b) { return a.omega_2 > b.omega_2; });
  double total = 0, mass = 0, weighed = 0; // of those faster than the rate: sums of m and of m omega^2
  for (auto const& t : tets) total += t.mass;
  for (auto const& t : tets) {
    // with the rate at this tet's, the faster ones get weighed/rate - mass
    if (t.omega_2 <= least || weighed / t.omega_2 - mass > most_added * total) break;
    mass += t.mass, weighed += t.mass * t.omega_2;
  }
  return std::max(least, weighed / (mass + most_added * total));
}

/// Tets that are faster than the rate when they have come loose get the mass that they need.
void lift_loose_tets(Model& m) {
  std::vector<double> factor;
  for (auto const& t : loose_tets(m)) factor.push_back(std::max(1.0, t.omega_2 / m.points.rate));
  model::scale_masses(m, factor);
}

/// What tets and bars ask for at the rate r, on top of the joints' 2 d/r: m w^2/r for the tet of a cluster
/// that its neighbours no longer hold, 2 b/r for bars, which pull at single tets once a crack has opened.
void set_own_inertia(Model& m) {
  auto& p = m.points;
  std::vector<double> bars(4 * static_cast<std::size_t>(m.tets.count), 0);
  rebar::add_bar_stiffness(m.bars, bars);
  std::fill(p.own.begin(), p.own.end(), 0.0);
  for (std::size_t t = 0; t < static_cast<std::size_t>(m.tets.count); ++t) {
    double const* const mass = m.mass.data() + 4 * t;
    double const omega_2 = elastic_bound(m, t, {mass[0], mass[1], mass[2], mass[3]});
    for (std::size_t a = 0; a < 4; ++a)
      p.own[static_cast<std::size_t>(p.cluster_of[4 * t + a])] +=
          (mass[a] * omega_2 + 2 * bars[4 * t + a]) / p.rate;
  }
}

/// The step that every tet can take alone, should it come loose [s].
double step_of_loose_tets(Model const& m) {
  double dt = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < static_cast<std::size_t>(m.tets.count); ++t) {
    double const* const mass = m.mass.data() + 4 * t;
    std::array<double, 4> const masses{mass[0], mass[1], mass[2], mass[3]};
    dt = std::min(dt, largest_step(std::sqrt(elastic_bound(m, t, masses)), viscous_bound(m, t, masses)));
  }
  return dt;
}

} // namespace

TiedBody tied_body(Model const& m) {
  constexpr double near = 0.97; // of the tied body's step
  double const omega_2 = highest_frequency(m, Copies::tied).omega_2;
  return {omega_2, rate_for_loose_tets(loose_tets(m), omega_2 / (near * near))};
}

double inertia_of_joint(Model const& m, std::size_t joint, double rate) {
  return 0.5 * motion::joint_share * m.joints.k(joint) / rate; // two sides in series
}

StableStep choose_inertia(Model& m, TiedBody const& tied) {
  constexpr int most_rounds = 4;
  m.points.rate = tied.rate;
  double const wanted = 4 / m.points.rate; // dt^2
  lift_loose_tets(m);
  StableStep stable;
  for (int round = 0; round < most_rounds; ++round) {
    set_own_inertia(m);
    stable = stable_step(m);
    double const reached = stable.dt * stable.dt / wanted;
    if (reached > 0.98) break;
    m.points.rate *= std::max(0.5, reached);
  }
  stable.of_loose_tets = step_of_loose_tets(m);
  stable.limiter = fmt::format("the body with its joints' inertia, {:.2f} of its step without joints",
                               0.5 * stable.dt * std::sqrt(tied.omega_2));
  return stable;
}

} // namespace fissura::step
