#include "fissura/sim/stops.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace fissura::sim {

namespace {

/// A value as an engineer reads it: kN, mm and MPa.
std::string shown(double value, std::string const& unit) {
  double const size = std::abs(value);
  if (unit == "N" && size >= 500) return fmt::format("{:.4g} kN", 1e-3 * value);
  if (unit == "m" && size < 10) return fmt::format("{:.4g} mm", 1e3 * value);
  if (unit == "Pa" && size >= 1e4) return fmt::format("{:.4g} MPa", 1e-6 * value);
  return fmt::format("{:.4g}{}{}", value, unit == "-" ? "" : " ", unit == "-" ? "" : unit);
}

} // namespace

Stops::Stops(model::Case const& c, Gauges const& gauges) {
  for (auto const& s : c.stops) {
    int const gauge = gauges.find(s.gauge);
    if (gauge < 0) throw core::InputError(s.place, fmt::format("[[stop]]: there is no gauge `{}`", s.gauge));
    watches_.push_back({s, gauge, gauges.columns()[static_cast<std::size_t>(gauge)].unit});
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
      return fmt::format("{} = {} rose above {}", s.gauge, shown(now, w.unit), shown(s.above, w.unit));
    if (s.has_below && now < s.below)
      return fmt::format("{} = {} fell below {}", s.gauge, shown(now, w.unit), shown(s.below, w.unit));
    if (s.falls_to > 0 && w.peak > s.after && mean < s.falls_to * w.peak)
      return fmt::format("{} of {} has fallen below {:.3g} of its peak {}", s.gauge, shown(mean, w.unit),
                         s.falls_to, shown(w.peak, w.unit));
  }
  return std::nullopt;
}

} // namespace fissura::sim
