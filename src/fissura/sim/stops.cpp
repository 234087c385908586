#include "fissura/sim/stops.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace fissura::sim {

Stops::Stops(model::Case const& c, Gauges const& gauges) {
  for (auto const& s : c.stops) {
    int const gauge = gauges.find(s.gauge);
    if (gauge < 0) throw core::InputError(s.place, fmt::format("[[stop]]: there is no gauge `{}`", s.gauge));
    watches_.push_back({s, gauge});
  }
}

double Stops::Watch::mean_with(double reading) {
  last[readings++ % last.size()] = reading;
  std::size_t const count = std::min(readings, last.size());
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += last[i];
  return sum / static_cast<double>(count);
}

std::optional<std::string> Stops::met(Gauges const& gauges) {
  for (auto& w : watches_) {
    double const now = gauges.values()[static_cast<std::size_t>(w.gauge)];
    double const mean = std::abs(w.mean_with(now));
    w.peak = std::max(w.peak, mean);
    auto const& s = w.spec;
    if (s.has_above && now > s.above)
      return fmt::format("{} = {:.6g} rose above {:.6g}", s.gauge, now, s.above);
    if (s.has_below && now < s.below)
      return fmt::format("{} = {:.6g} fell below {:.6g}", s.gauge, now, s.below);
    if (s.falls_to > 0 && w.peak > s.after && mean < s.falls_to * w.peak)
      return fmt::format("|{}| = {:.6g} has fallen below {:.3g} of its peak {:.6g}", s.gauge, mean,
                         s.falls_to, w.peak);
  }
  return std::nullopt;
}

} // namespace fissura::sim
