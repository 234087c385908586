#include "fissura/sim/monitor.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "fissura/core/finite.hpp"
#include "fissura/loads/loads.hpp"
#include "fissura/sim/coarse_loads.hpp"
#include "fissura/sim/guards.hpp"
#include "fissura/sim/spots.hpp"

namespace fissura::sim {

using model::Model;
using state::State;

BarCounts count_bars(state::BarState const& bars) {
  BarCounts n;
  for (std::size_t i = 0; i < bars.history.size(); ++i) {
    n.activated += bars.is_activated(i);
    n.yielded += bars.has_yielded(i);
    n.broken += bars.is_broken(i);
  }
  return n;
}

Monitor::Monitor(Model const& m) {
  any_paper_ = std::find(m.tets.is_paper.begin(), m.tets.is_paper.end(), 1) != m.tets.is_paper.end();
  // Guards act once the energy put in is no longer tiny: a thousandth of what cracks the whole volume
  // elastically.
  for (std::size_t t = 0; t < static_cast<std::size_t>(m.tets.count); ++t) {
    auto const& c = m.source.concretes[m.material_of_tet[t]];
    double const strain = std::max(c.f_t / c.E, 1e-5);
    floor_ += 1e-3 * m.tets.volume[t] * c.E * strain * strain / 2;
  }
}

std::optional<Trouble> Monitor::take(step::EnergyBalance const& e, Model const& m, State const& s) {
  // The logarithm in the strain energy finds tets that are inside out; only the law `paper` has none.
  if (!core::is_finite(e.strain) || any_paper_)
    if (auto found = inverted_tet(m, s)) return found;
  if (!core::is_finite(e.held()) || !core::is_finite(e.dissipated()) || !core::is_finite(e.work()))
    return not_finite(m, s);
  scale_ = std::max(scale_, e.start + e.absolute_work);
  if (std::abs(e.missing()) > std::abs(worst_missing_)) worst_missing_ = e.missing();
  Reading reading{.time = s.time, .kinetic = e.kinetic, .internal = e.internal(), .resultant = {}};
  weigh_forces(reading, m, s);
  last_imbalance_ = reading.forces > 0 ? norm(reading.resultant) / reading.forces : 0;
  readings_.push_back(reading);
  if (scale_ < floor_ || scale_ <= 0) return std::nullopt;
  double const now = e.missing() / scale_;
  if (std::abs(now) > m.source.run.residual_warn) warned_ = true;
  if (std::abs(now) > m.source.run.residual_stop) return unbalanced(now, m, s);
  return std::nullopt;
}

Trouble Monitor::unbalanced(double residual, Model const& m, State const& s) {
  Trouble t;
  t.kind = "energy";
  t.what = fmt::format("the energy balance is off by {:+.2g} % of the energy put in: energy was {}",
                       100 * residual, residual < 0 ? "created" : "lost");
  auto const fastest = fastest_tet(m, s);
  t.spot = tet_spot(m, fastest.tet);
  t.spot.what = fmt::format("the fastest ({:.3g} m/s) is {}", fastest.speed, t.spot.what);
  t.time = s.time, t.step = s.step;
  t.cause = residual < 0 ? "the time step is too large, or contact between fragments is too stiff for it"
                         : "energy went where no account books it";
  t.cure =
      "lower [run] dt_factor and look at the energy columns of history.csv; raise [run] residual_stop only "
      "where this is understood";
  if (auto const coarse = coarse_loads(m); !coarse.empty() && residual < 0) {
    t.cause = coarse.front().substr(0, coarse.front().find(';'));
    t.cure = "let the load take twenty steps or more, or shorten the step: `least_dt`, `density` and `E` "
             "govern it";
  }
  return t;
}

void Monitor::weigh_forces(Reading& reading, Model const& m, State const& s) {
  Vec3 resultant = m.total_mass * loads::gravity_at(m, s, s.load_time());
  double sum = norm(resultant);
  for (std::size_t i = 0; i < m.prescribed.size(); ++i) {
    resultant[m.prescribed[i].axis] += s.reaction[i];
    sum += std::abs(s.reaction[i]);
  }
  for (auto const& f : m.forces) {
    Vec3 const force = loads::value_at(f.curve, s, s.load_time()) * f.total();
    resultant += force;
    sum += norm(force);
  }
  for (auto const& body : s.rigid.body) {
    resultant += body.force;
    sum += norm(body.force);
  }
  reading.resultant = resultant;
  reading.forces = 0.5 * sum;
}

double Monitor::kinetic_ratio() const {
  double largest = 0, ratio = 0;
  for (auto const& s : readings_) largest = std::max(largest, s.internal);
  for (auto const& s : readings_)
    if (s.internal > 0.01 * largest) ratio = std::max(ratio, s.kinetic / s.internal);
  return ratio;
}

} // namespace fissura::sim
