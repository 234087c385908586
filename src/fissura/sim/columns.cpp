#include "fissura/sim/columns.hpp"

#include <algorithm>
#include <fmt/core.h>

#include "fissura/step/ledger.hpp"

namespace fissura::sim {
namespace {

/// Whether the run has them or not, a gauge may not be named like them: a deck with a pace is soon made.
std::vector<output::Column> paced_columns() {
  return {{"load_time", "s"}, {"pace", "-"}};
}

} // namespace

std::vector<output::Column> own_columns(model::Model const& m) {
  std::vector<output::Column> columns;
  for (auto const& p : m.prescribed)
    columns.push_back({fmt::format("reaction_{}_{}", p.name, "xyz"[p.axis]), "N"});
  for (auto const& [name, value] : step::EnergyBalance{}.accounts())
    columns.push_back({fmt::format("energy_{}", name), "J"});
  columns.push_back({"energy_residual", "-"});
  for (char const* count : {"joints_damaged", "joints_cracked", "joints_broken", "bar_joints_activated",
                            "bar_joints_yielded", "bars_broken", "fragments"})
    columns.push_back({count, "-"});
  if (m.source.run.pace > 1)
    for (auto& column : paced_columns()) columns.push_back(std::move(column));
  return columns;
}

void check_gauge_names(model::Model const& m) {
  auto taken = own_columns(m);
  taken.push_back({"time", "s"});
  for (auto& column : paced_columns()) taken.push_back(std::move(column));
  for (auto const& gauge : m.source.gauges)
    if (std::any_of(taken.begin(), taken.end(), [&](auto const& c) { return c.name == gauge.name; }))
      throw core::InputError(gauge.place,
                             fmt::format("the name \"{}\" is taken: history.csv has a column of the "
                                         "program's own with it; give the [[gauge]] another one",
                                         gauge.name));
}

} // namespace fissura::sim
