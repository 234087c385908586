#include "fissura/sim/coarse_loads.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "fissura/units/units.hpp"

namespace fissura::sim {

using model::Curve;
using model::Model;

namespace {

/// A smooth ramp in so many steps is one; in fewer it is a stair [-].
constexpr double enough_steps = 20;

/// A duration in which the load changes, and what it is; 0 where it does not.
std::pair<double, char const*> shortest_change(Curve const& c) {
  if (c.kind == Curve::Kind::ramp && c.value != c.from) return {c.over, "its ramp of"};
  if (c.kind == Curve::Kind::cycles) return {0.25 * c.period, "a quarter of its cycles,"};
  return {0, ""};
}

std::string time(double seconds) {
  return units::from_si(std::strtod(fmt::format("{:.3g}", seconds).c_str(), nullptr), units::Dimension::time);
}

void look(Model const& m, std::string const& who, Curve const& curve, std::vector<std::string>& found) {
  auto const [duration, what] = shortest_change(curve);
  double const pace = std::max(1.0, m.source.run.pace), steps = duration / pace / m.dt;
  if (duration > 0 && steps < enough_steps)
    found.push_back(fmt::format(
        "{}: {} {}{} has {:.2g} time step{} of {}: it comes as a jump that the energy "
        "balance cannot follow; let it take {} or more, or shorten the step (`least_dt`, "
        "`density` and `E` govern it)",
        who, what, time(duration), pace > 1 ? fmt::format(", {:.3g} times faster with its pace,", pace) : "",
        steps, fmt::format("{:.2g}", steps) == "1" ? "" : "s", time(m.dt), time(enough_steps * pace * m.dt)));
}

/// Rows that lie closer together than the steps are passed over.
void look_at_rows(Model const& m, std::string const& who, Curve const& c, std::vector<std::string>& found) {
  if (c.kind != Curve::Kind::table || c.times.size() < 3) return;
  double const mean = (c.times.back() - c.times.front()) / static_cast<double>(c.times.size() - 1);
  double const pace = std::max(1.0, m.source.run.pace);
  if (mean < pace * m.dt)
    found.push_back(fmt::format("{}: its rows follow each other after {}, the time step is {}: most rows are "
                                "passed over; is the unit of its times right?",
                                who, time(mean), time(m.dt)));
}

} // namespace

std::vector<std::string> coarse_loads(Model const& m) {
  std::vector<std::string> found;
  auto const both = [&](std::string const& who, Curve const& curve) {
    look(m, who, curve, found);
    look_at_rows(m, who, curve, found);
  };
  auto const& c = m.source;
  for (auto const& x : c.motions)
    if (!x.path && !x.record) both(fmt::format("motion `{}`", x.name), x.curve);
  for (auto const& p : m.prescribed)
    if (!p.motion.curve.slopes.empty())
      look_at_rows(m, fmt::format("motion `{}`", p.name), p.motion.curve, found);
  for (auto const& x : c.forces) both(fmt::format("force `{}`", x.name), x.curve);
  for (auto const& x : c.tractions) both(fmt::format("traction `{}`", x.name), x.curve);
  if (c.gravity.on) both("gravity", c.gravity.curve);
  for (auto const& x : c.motions)
    if (x.path && x.path->turn > 0 && x.path->turn < enough_steps * m.dt)
      found.push_back(fmt::format(
          "motion `{}`: its `turn` of {} has {:.2g} time steps of {}: it turns with a jump; "
          "let it take {} or more",
          x.name, time(x.path->turn), x.path->turn / m.dt, time(m.dt), time(enough_steps * m.dt)));
  return found;
}

} // namespace fissura::sim
