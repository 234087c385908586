#include "fissura/sim/stops.hpp"

#include <cmath>
#include <fmt/format.h>

namespace fissura::sim {

Stops::Stops(model::Case const& c, Gauges const& gauges) {
  for (auto const& s : c.stops) {
    int const gauge = gauges.find(s.gauge);
    if (gauge < 0) throw core::InputError(s.place, fmt::format("[[stop]]: there is no gauge `{}`", s.gauge));
    watches_.push_back({s, gauge});
  }
}

std::optional<std::string> Stops::met(Gauges const& gauges) {
  for (auto& w : watches_) {
    double const now = gauges.values()[static_cast<std::size_t>(w.gauge)];
    w.peak = std::max(w.peak, std::abs(now));
    auto const& s = w.spec;
    if (s.has_above && now > s.above)
      return fmt::format("{} = {:.6g} rose above {:.6g}", s.gauge, now, s.above);
    if (s.has_below && now < s.below)
      return fmt::format("{} = {:.6g} fell below {:.6g}", s.gauge, now, s.below);
    if (s.falls_to > 0 && w.peak > s.after && std::abs(now) < s.falls_to * w.peak)
      return fmt::format("|{}| = {:.6g} has fallen below {:.3g} of its peak {:.6g}", s.gauge, std::abs(now),
                         s.falls_to, w.peak);
  }
  return std::nullopt;
}

} // namespace fissura::sim
