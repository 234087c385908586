#include "fissura/report/history_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/deck/deck.hpp"

namespace fissura::report {

namespace {

constexpr std::size_t most_rows = 6000;

/// Rows that every thinned curve keeps: first, last, extremes, and where a count leaves zero.
void mark_rows(History::Column const& c, std::vector<char>& keep) {
  std::size_t low = 0, high = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.values[i] < c.values[low]) low = i;
    if (c.values[i] > c.values[high]) high = i;
    if (i > 0 && c.values[i] != 0 && c.values[i - 1] == 0) keep[i] = 1;
  }
  keep[low] = keep[high] = 1;
}

std::vector<std::size_t> rows_to_keep(History const& h) {
  std::size_t const rows = h.rows();
  std::vector<char> keep(rows, 0);
  if (rows > 0) keep.front() = keep.back() = 1;
  for (std::size_t i = 0; i < most_rows && i < rows; ++i)
    keep[rows <= most_rows ? i : i * rows / most_rows] = 1;
  for (auto const& c : h.columns)
    if (rows > most_rows) mark_rows(c, keep);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < rows; ++i)
    if (keep[i] != 0) kept.push_back(i);
  return kept;
}

char const* kind_name(model::GaugeSpec::Kind kind) {
  using Kind = model::GaugeSpec::Kind;
  switch (kind) {
  case Kind::displacement:
    return "displacement";
  case Kind::velocity:
    return "velocity";
  case Kind::reaction:
    return "reaction";
  case Kind::force:
    return "force";
  case Kind::bar:
    return "bar";
  case Kind::crack_width:
    return "crack_width";
  case Kind::mean_strain:
    return "mean_strain";
  case Kind::contact_force:
    return "contact_force";
  case Kind::contact_impulse:
    return "contact_impulse";
  case Kind::impactor_displacement:
    return "impactor_displacement";
  case Kind::impactor_velocity:
    return "impactor_velocity";
  }
  return "";
}

int turns_of(model::Curve const& c) {
  if (c.kind == model::Curve::Kind::cycles) return 2 * c.repeats * static_cast<int>(c.peaks.size());
  int turns = 0;
  double way = 0;
  for (std::size_t i = 1; i < c.values.size(); ++i) {
    double const step = c.values[i] - c.values[i - 1];
    turns += step * way < 0;
    if (step != 0) way = step;
  }
  return turns;
}

/// Whether some load goes to and fro on purpose: cycles, a table that turns twice, a path with several
/// targets.
bool is_cyclic(model::Case const& c) {
  bool found = false;
  for (auto const& m : c.motions) {
    found |= turns_of(m.curve) >= 2;
    found |= m.path && m.path->targets.size() >= 2;
  }
  for (auto const& f : c.forces) found |= turns_of(f.curve) >= 2;
  return found;
}

} // namespace

void add_history(Blob& blob, std::string const& name, History const& history) {
  auto const rows = rows_to_keep(history);
  output::Json columns = output::Json::array();
  std::vector<float> values;
  for (std::size_t i = 0; i < history.columns.size(); ++i) {
    auto const& c = history.columns[i];
    values.clear();
    for (std::size_t const row : rows) values.push_back(static_cast<float>(c.values[row]));
    blob.add(fmt::format("{}/{}", name, i), std::span<float const>(values));
    columns.push_back({{"name", c.name}, {"unit", c.unit}});
  }
  blob.meta[name] = {{"rows", rows.size()}, {"columns", columns}};
}

output::Json describe_deck(RunFolder const& run) {
  output::Json d = {{"gauges", output::Json::array()},
                    {"bars", output::Json::array()},
                    {"dynamic", false},
                    {"cyclic", false}};
  if (run.deck.empty()) return d;
  try {
    auto const c = deck::read_case_text(run.deck, run.path() + "/case.toml");
    d["title"] = c.title;
    for (auto const& g : c.gauges) d["gauges"].push_back({{"name", g.name}, {"kind", kind_name(g.kind)}});
    for (auto const& b : c.bars) {
      output::Json bar = {{"name", b.name}, {"diameter", b.diameter}, {"count", b.count}};
      for (auto const& s : c.steels)
        if (s.name == b.steel) bar["f_y"] = s.f_y, bar["f_u"] = s.f_u;
      d["bars"].push_back(bar);
    }
    bool moving = !c.impactors.empty() || !c.initial_velocities.empty() || !c.absorbing.empty();
    for (auto const& m : c.motions) moving |= m.record.has_value();
    d["dynamic"] = moving; // inertia is meant to matter
    d["cyclic"] = is_cyclic(c);
  } catch (core::Error const&) {
    d["unreadable"] = true;
  }
  return d;
}

} // namespace fissura::report
