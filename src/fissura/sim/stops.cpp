#include "fissura/sim/stops.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "fissura/core/finite.hpp"
#include "fissura/deck/deck.hpp"

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
  for (std::size_t i = 0; i < c.stops.size(); ++i) {
    auto const& s = c.stops[i];
    int const gauge = gauges.find(s.gauge);
    if (gauge < 0) throw core::InputError(s.place, fmt::format("[[stop]]: there is no gauge `{}`", s.gauge));
    auto const at = static_cast<std::size_t>(gauge);
    watches_.push_back({s, gauge, gauges.columns()[at].unit, {}});
    watches_.back().memory.definition = deck::echo_item(c, "stop", i) + gauges.definition(at);
  }
}

double Stops::Watch::mean_with(double reading) {
  auto& last = memory.last;
  last[memory.readings++ % last.size()] = reading;
  std::size_t const count = std::min(memory.readings, last.size());
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += last[i];
  return sum / static_cast<double>(count);
}

std::optional<std::string> Stops::Watch::met(double now) {
  double const mean = std::abs(mean_with(now));
  memory.peak = std::max(memory.peak, mean);
  if (spec.has_above && now > spec.above)
    return fmt::format("{} = {} rose above {}", spec.gauge, shown(now, unit), shown(spec.above, unit));
  if (spec.has_below && now < spec.below)
    return fmt::format("{} = {} fell below {}", spec.gauge, shown(now, unit), shown(spec.below, unit));
  if (spec.falls_to > 0 && memory.peak > spec.after && mean < spec.falls_to * memory.peak)
    return fmt::format("{} of {} has fallen below {:.3g} of its peak {}", spec.gauge, shown(mean, unit),
                       spec.falls_to, shown(memory.peak, unit));
  return std::nullopt;
}

std::optional<std::string> Stops::met(Gauges const& gauges) {
  std::optional<std::string> first;
  for (auto& w : watches_) { // all of them: the run may be gone on with
    auto met = w.met(gauges.values()[static_cast<std::size_t>(w.gauge)]);
    if (met && !first) first = std::move(met);
  }
  return first;
}

std::vector<SavedStop> Stops::saved() const {
  std::vector<SavedStop> list;
  for (auto const& w : watches_) list.push_back(w.memory);
  return list;
}

bool Stops::go_on_from(std::vector<SavedStop> const& saved, OldHistory const& old, Gauges const& gauges) {
  bool is_same = saved.size() == watches_.size();
  for (std::size_t i = 0; i < watches_.size(); ++i)
    is_same = is_same && saved[i].definition == watches_[i].memory.definition;
  for (auto& w : watches_) {
    auto const found = std::find_if(saved.begin(), saved.end(),
                                    [&](auto const& s) { return s.definition == w.memory.definition; });
    if (found != saved.end()) w.memory = *found;
    // One that has ended the run and is still there ends it again.
    if (found == saved.end() || !is_same)
      w.memory = {w.memory.definition, {}, 0, 0}, look_back(w, old, gauges);
  }
  return is_same;
}

void Stops::look_back(Watch& watch, OldHistory const& old, Gauges const& gauges) const {
  auto const gauge = static_cast<std::size_t>(watch.gauge);
  if (gauges.is_new()[gauge]) return; // it has no rows yet
  for (std::size_t row = 0; row < old.rows.size(); row += old.column_count) {
    double const reading = old.rows[row + 1 + gauge];
    if (!core::is_finite(reading)) continue; // from before the gauge was there
    if (auto const met = watch.met(reading))
      throw core::InputError(
          watch.spec.place,
          fmt::format(
              "[[stop]]: {} at t = {:.5g} s, before the checkpoint: the run would have ended there; run "
              "it anew, go on from an older checkpoint, or leave this out",
              *met, old.rows[row]));
  }
}

} // namespace fissura::sim
