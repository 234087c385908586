#include "fissura/sim/trouble.hpp"

#include <fmt/core.h>

namespace fissura::sim {

std::string describe(Spot const& s) {
  std::string text = s.field.empty() ? s.what : fmt::format("the {} of {}", s.field, s.what);
  if (s.has_place) text += fmt::format(" at ({:.4g}, {:.4g}, {:.4g}) m", s.at.x, s.at.y, s.at.z);
  return text;
}

std::string describe(Trouble const& t) {
  return fmt::format("{}: {}, t = {:.6g} s, step {}. Likely cause: {}. Cure: {}.", t.what, describe(t.spot),
                     t.time, t.step, t.cause, t.cure);
}

} // namespace fissura::sim
