#pragma once
// Energies of a bar element and of an intact bar joint as functions of the state [J].
#include "fissura/model/bars.hpp"
#include "fissura/state/bar_state.hpp"

namespace fissura::rebar {

/// Energy of an element with all of its stiffness, 1/2 E_s A_s l_i eps^2.
inline double elastic_energy(model::Bars const& bars, state::BarState const& s, int element) {
  auto const& e = bars.elements[static_cast<std::size_t>(element)];
  auto const& bar = bars.properties[static_cast<std::size_t>(e.bar)];
  double const strain = s.elongation[static_cast<std::size_t>(element)] / e.length + bar.initial_strain;
  return 0.5 * bar.steel.E_s * bar.area * e.length * strain * strain;
}

/// Energy of a joint that has not been activated at d.r = axial [m]; 0 at rest, also with prestress.
inline double intact_energy(model::BarJointLaw const& law, double axial) {
  return law.intact.stored(axial) + law.intact.A_s * law.prestress * axial;
}

} // namespace fissura::rebar
