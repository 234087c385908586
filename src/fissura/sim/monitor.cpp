#include "fissura/sim/monitor.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "fissura/core/finite.hpp"
#include "fissura/loads/loads.hpp"

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
  // Guards act once the energy put in is no longer tiny: a thousandth of what cracks the whole volume
  // elastically.
  for (std::size_t t = 0; t < static_cast<std::size_t>(m.tets.count); ++t) {
    auto const& c = m.source.concretes[m.material_of_tet[t]];
    double const strain = std::max(c.f_t / c.E, 1e-5);
    floor_ += 1e-3 * m.tets.volume[t] * c.E * strain * strain / 2;
  }
}

std::optional<std::string> Monitor::take(step::EnergyBalance const& e, Model const& m, State const& s) {
  if (!core::is_finite(e.held()) || !core::is_finite(e.dissipated())) {
    std::string const where = find_non_finite(m, s);
    return fmt::format(
        "a number is no longer finite at t = {:.6g} s, {}; likely the time step is too large (lower "
        "[run] dt_factor) or an element has collapsed",
        s.time, where.empty() ? "in the energies" : where);
  }
  scale_ = std::max(scale_, e.start + e.absolute_work);
  if (std::abs(e.missing()) > std::abs(worst_missing_)) worst_missing_ = e.missing();
  shares_.push_back({e.kinetic, e.internal()});
  weigh_forces(m, s);
  if (scale_ < floor_ || scale_ <= 0) return std::nullopt;
  double const now = e.missing() / scale_;
  if (std::abs(now) > m.source.run.residual_warn) warned_ = true;
  if (std::abs(now) > m.source.run.residual_stop)
    return fmt::format(
        "the energy balance is off by {:.2g} % of the energy put in at t = {:.6g} s ({}); lower [run] "
        "dt_factor or raise [run] residual_stop if this is understood",
        100 * now, s.time, now < 0 ? "energy was created" : "energy was lost");
  return std::nullopt;
}

void Monitor::weigh_forces(Model const& m, State const& s) {
  Vec3 resultant = m.total_mass * loads::gravity_at(m, s, s.time);
  double sum = norm(resultant);
  for (std::size_t i = 0; i < m.prescribed.size(); ++i) {
    resultant[m.prescribed[i].axis] += s.reaction[i];
    sum += std::abs(s.reaction[i]);
  }
  for (auto const& f : m.forces) {
    Vec3 const force = loads::value_at(f.curve, s, s.time) * f.total();
    resultant += force;
    sum += norm(force);
  }
  for (auto const& body : s.rigid.body) {
    resultant += body.force;
    sum += norm(body.force);
  }
  resultant_ += norm(resultant);
  last_imbalance_ = sum > 0 ? norm(resultant) / (0.5 * sum) : 0;
  all_forces_ += 0.5 * sum; // each force and what holds it
}

double Monitor::quiet_share() const {
  double largest = 0;
  for (auto const& s : shares_) largest = std::max(largest, s.internal);
  long quiet = 0, counted = 0;
  for (auto const& s : shares_) {
    if (!(s.internal > 0.01 * largest)) continue;
    ++counted;
    quiet += s.kinetic < 0.05 * s.internal;
  }
  return counted > 0 ? static_cast<double>(quiet) / static_cast<double>(counted) : 0;
}

double Monitor::kinetic_ratio() const {
  double largest = 0, ratio = 0;
  for (auto const& s : shares_) largest = std::max(largest, s.internal);
  for (auto const& s : shares_)
    if (s.internal > 0.01 * largest) ratio = std::max(ratio, s.kinetic / s.internal);
  return ratio;
}

std::string find_non_finite(Model const& m, State const& s) {
  for (int t = 0; t < m.tets.count; ++t)
    for (int i = 0; i < 16; ++i) {
      std::size_t const k = 16 * static_cast<std::size_t>(t) + static_cast<std::size_t>(i);
      if (core::is_finite(s.u[k]) && core::is_finite(s.v[k])) continue;
      auto const x = mesh::corners(m.mesh, t);
      Vec3 const at = 0.25 * (x[0] + x[1] + x[2] + x[3]);
      return fmt::format("in tet {} of group {} at ({:.4g}, {:.4g}, {:.4g}) m", m.mesh.input_id[t],
                         m.mesh.volume_groups[m.mesh.tet_group[t]], at.x, at.y, at.z);
    }
  return {};
}

} // namespace fissura::sim
