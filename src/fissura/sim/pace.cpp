#include "fissura/sim/pace.hpp"

#include <algorithm>
#include <cmath>

namespace fissura::sim {

namespace {

constexpr double transits_to_rise = 20, fall_over_rise = 10;

/// Time of a compression wave through the diagonal of the structure [s].
double transit(model::Model const& m) {
  auto [low, high] = std::pair{m.mesh.points.front(), m.mesh.points.front()};
  for (Vec3 const p : m.mesh.points)
    for (int r = 0; r < 3; ++r) low[r] = std::min(low[r], p[r]), high[r] = std::max(high[r], p[r]);
  double slowest = 1e300;
  for (auto const& c : m.source.concretes)
    slowest = std::min(slowest, std::sqrt(c.E / (c.density * c.density_factor)));
  return norm(high - low) / slowest;
}

} // namespace

PaceControl::PaceControl(model::Model const& m)
    : most_(m.source.run.pace), kinetic_ratio_(m.source.run.pace_kinetic),
      steps_to_next_(m.source.run.energy_every), rise_(is_on() ? m.dt / (transits_to_rise * transit(m)) : 0) {
}

void PaceControl::steer(double kinetic, double internal, state::State& s) const {
  double const allowed = kinetic_ratio_ * internal;
  double const least = std::exp(-2 * fall_over_rise) * kinetic; // no logarithm of zero
  double const wish = kinetic > 0 ? 0.5 * std::log(std::max(allowed, least) / kinetic) : 1;
  double const to_most = std::log(most_ / s.pace) / steps_to_next_;
  double const to_least = -std::log(s.pace) / steps_to_next_;
  s.pace_growth = std::exp(std::clamp(rise_ * std::clamp(wish, -fall_over_rise, 1.0), std::min(to_least, 0.0),
                                      std::max(to_most, 0.0)));
}

} // namespace fissura::sim
