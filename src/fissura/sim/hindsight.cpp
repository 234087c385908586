#include "fissura/sim/hindsight.hpp"

#include <cmath>
#include <fmt/core.h>

#include "fissura/units/units.hpp"

namespace fissura::sim {

using model::Model;
using state::State;

namespace {

/// A stress that only rounding carries past the yield strength is none of it.
constexpr double clearly_beyond = 1.01;

bool is_at_a_crack(State const& s, model::BarElement const& e) {
  auto const cracked = [&](int joint) {
    return joint >= 0 && s.bars.is_activated(static_cast<std::size_t>(joint));
  };
  return cracked(e.joint0) || cracked(e.joint1);
}

} // namespace

std::vector<std::string> steel_beyond_yield(Model const& m, State const& s) {
  std::vector<double> largest(m.bars.properties.size(), 0);
  for (std::size_t i = 0; i < m.bars.elements.size(); ++i) {
    auto const& e = m.bars.elements[i];
    auto& most = largest[static_cast<std::size_t>(e.bar)];
    if (!is_at_a_crack(s, e)) most = std::max(most, std::abs(s.bars.element_stress[i]));
  }
  std::vector<std::string> found;
  for (std::size_t bar = 0; bar < largest.size(); ++bar) {
    auto const& properties = m.bars.properties[bar];
    if (largest[bar] <= clearly_beyond * properties.steel.f_y) continue;
    found.push_back(fmt::format(
        "bar `{}` carries {} where its concrete has not cracked, more than its f_y of {}: steel yields at "
        "cracks only, there it is elastic; give it concrete that may crack, or do not use that stress",
        properties.name, units::from_si(largest[bar], units::Dimension::pressure),
        units::from_si(properties.steel.f_y, units::Dimension::pressure)));
  }
  return found;
}

} // namespace fissura::sim
