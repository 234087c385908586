#include "fissura/sim/guards.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "fissura/concrete/concrete.hpp"
#include "fissura/core/finite.hpp"
#include "fissura/sim/spots.hpp"

namespace fissura::sim {

using model::Model;
using state::State;

namespace {

constexpr char const* smaller_steps =
    "lower [run] dt_factor (or [run] dt, where it is given) and begin again from the last good checkpoint";

Trouble trouble(State const& s, std::string kind, std::string what, Spot spot) {
  Trouble t;
  t.kind = std::move(kind), t.what = std::move(what), t.spot = std::move(spot);
  t.time = s.time, t.step = s.step;
  return t;
}

/// J of a tet whose displacements are finite.
double volume_ratio(Model const& m, State const& s, int tet) {
  return determinant(concrete::displacement_gradient(m, s, tet) + Mat3::identity());
}

void blame(Trouble& t, char const* cause, std::string cure) {
  t.cause = cause;
  t.cure = std::move(cure);
}

} // namespace

Guards::Guards(Model const& m) {
  for (auto const& c : m.source.concretes) {
    double const modulus = c.E * (1 - c.nu) / ((1 + c.nu) * (1 - 2 * c.nu));
    fastest_ = std::max(fastest_, std::sqrt(modulus / c.density));
  }
  double lightest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < 4 * static_cast<std::size_t>(m.tets.count); ++n)
    lightest = std::min(lightest, m.mass[n]);
  kinetic_at_ease_ = 0.5 * lightest * fastest_ * fastest_;
}

std::optional<Trouble> Guards::after_step(Model const& m, State const& s) const {
  // Whatever moves is in this sum, which the step has taken anyway.
  if (!core::is_finite(s.ledger.kinetic_before)) return not_finite(m, s);
  if (s.step % interval != 0) return std::nullopt;
  if (!idle_memory_is_finite(m, s)) return not_finite(m, s);
  return find_runaway(m, s);
}

std::optional<Trouble> Guards::look_everywhere(Model const& m, State const& s) const {
  if (find_non_finite_motion(m, s) || !memory_is_finite(m, s)) return not_finite(m, s);
  if (auto found = find_runaway(m, s)) return found;
  return inverted_tet(m, s);
}

std::optional<Trouble> Guards::find_runaway(Model const& m, State const& s) const {
  if (s.ledger.kinetic_before < kinetic_at_ease_) return std::nullopt;
  auto const f = fastest_tet(m, s);
  if (f.speed <= fastest_) return std::nullopt;
  auto t = trouble(s, "runaway",
                   fmt::format("a node moves at {:.4g} m/s, faster than sound in this concrete ({:.4g} m/s)",
                               f.speed, fastest_),
                   tet_spot(m, f.tet, "velocity"));
  blame(t, "the time step is too large for what the model has become there, or the load is far too fast",
        smaller_steps);
  return t;
}

Trouble not_finite(Model const& m, State const& s) {
  auto spot = find_non_finite_motion(m, s);
  if (!spot) spot = find_non_finite_memory(m, s);
  if (!spot) spot = Spot{"the energies", "balance", {}, -1, false, {}};
  auto t = trouble(s, "not_finite", "a number is no longer finite", *spot);
  if (inverted_tet(m, s))
    blame(t,
          "a tet was turned inside out nearby, by too large a time step or by crushing that no law of the "
          "model stops",
          std::string(smaller_steps) + ", or coarsen the mesh there");
  else
    blame(t, "the time step is too large, or a property is so extreme that a law overflows", smaller_steps);
  return t;
}

std::optional<Trouble> inverted_tet(Model const& m, State const& s) {
  int worst = -1;
  double least = 0;
  for (int tet = 0; tet < m.tets.count; ++tet) {
    if (!core::all_finite(s.u.of_tet(static_cast<std::size_t>(tet)), core::per_tet)) continue;
    double const J = volume_ratio(m, s, tet);
    if (J <= 0 && (worst < 0 || J < least)) worst = tet, least = J;
  }
  if (worst < 0) return std::nullopt;
  auto t = trouble(s, "inverted_tet",
                   fmt::format("a tet is turned inside out (its volume is {:.3g} of what it was)", least),
                   tet_spot(m, worst));
  blame(t, "it was crushed beyond what its law can carry, or the time step is too large",
        std::string(smaller_steps) + ", load more slowly, or check the mesh and the supports there");
  return t;
}

} // namespace fissura::sim
