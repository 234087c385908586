#include "fissura/report/watch.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <string_view>

#include "fissura/core/error.hpp"
#include "fissura/core/printable.hpp"
#include "fissura/report/history_numbers.hpp"

namespace fissura::report {

namespace {

History::Column const& column(RunFolder const& run, std::string const& name) {
  if (auto const* c = run.history.find(name)) return *c;
  std::string names;
  for (auto const& c : run.history.columns) names += (names.empty() ? "" : ", ") + c.name;
  throw core::Error(core::Failure::input, fmt::format("{}: history.csv has no column `{}`; there are: {}",
                                                      run.path(), name, names));
}

/// Values and unit as an engineer reads them: kN, mm and MPa.
History::Column shown(History::Column c) {
  double largest = 0;
  for (double const v : c.values) largest = std::max(largest, std::abs(v));
  double factor = 1;
  if (c.unit == "N" && largest >= 500) factor = 1e-3, c.unit = "kN";
  if (c.unit == "m" && largest < 10) factor = 1e3, c.unit = "mm";
  if (c.unit == "Pa" && largest >= 1e4) factor = 1e-6, c.unit = "MPa";
  for (double& v : c.values) v *= factor;
  return c;
}

double last(RunFolder const& run, char const* name) {
  auto const* c = run.history.find(name);
  return c && !c->values.empty() ? c->values.back() : 0;
}

std::string counts(RunFolder const& run) {
  return fmt::format("joints cracked {:.0f}, broken {:.0f}   bar joints yielded {:.0f}   bars broken {:.0f}  "
                     " fragments {:.0f}\n",
                     last(run, "joints_cracked"), last(run, "joints_broken"), last(run, "bar_joints_yielded"),
                     last(run, "bars_broken"), std::max(1.0, last(run, "fragments")));
}

/// The line that says how far the run has come.
std::string progress(RunFolder const& run) {
  // Under pace control runs end by the time of the loads.
  double const now = last(run, run.history.find("load_time") ? "load_time" : "time"), end = planned_end(run);
  if (run.finished())
    return fmt::format("{}: {}\n", run.summary.value("status", "ended"), run.summary.value("reason", ""));
  if (!(end > 0)) return fmt::format("running   t = {:.5g} s\n", now);
  return fmt::format("[{}] {:.1f} %   t = {:.5g} of {:.5g} s\n", progress_bar(now / end, 40), 100 * now / end,
                     now, end);
}

} // namespace

double planned_end(RunFolder const& run) {
  constexpr std::string_view mark = " steps to t = ";
  for (auto const& line : run.log) {
    std::size_t const at = line.text.find(mark);
    if (at == std::string::npos) continue;
    double value = 0;
    char const* from = line.text.data() + at + mark.size();
    if (std::from_chars(from, line.text.data() + line.text.size(), value).ec == std::errc{}) return value;
  }
  return 0;
}

MainPair main_pair(RunFolder const& run) {
  auto const gauges = describe_deck(run)["gauges"];
  auto const first = [&](std::initializer_list<std::string_view> kinds) -> std::string {
    for (auto const& g : gauges) {
      std::string const kind = g["kind"], name = g["name"];
      if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end() && run.history.find(name)) return name;
    }
    return {};
  };
  auto const by_unit = [&](std::string_view unit) -> std::string {
    for (auto const& c : run.history.columns)
      if (c.unit == unit && !c.name.starts_with("energy_")) return c.name;
    return {};
  };
  MainPair pair{first({"displacement", "mean_strain", "impactor_displacement"}),
                first({"reaction", "force", "contact_force"})};
  if (pair.y.empty()) pair.y = by_unit("N");
  if (pair.y.empty()) pair.y = first({"bar"});
  if (pair.x.empty()) pair.x = by_unit("m");
  if (pair.x.empty()) pair.x = "time";
  if (pair.y.empty()) pair.y = run.history.columns.size() > 1 ? run.history.columns[1].name : "time";
  return pair;
}

std::string watch_screen(RunFolder const& run, WatchOptions const& options) {
  auto const deck = describe_deck(run);
  std::string const title = deck.value("title", "");
  std::string text = fmt::format("{}\n{}", title.empty() ? run.name() : title, progress(run));
  if (run.history.rows() == 0) return core::printable(text + "history.csv has no rows yet\n");
  text += fmt::format("energy residual {:+.2g} %   {}", 100 * last(run, "energy_residual"), counts(run));

  auto const chosen = main_pair(run);
  auto const x = shown(column(run, options.x.empty() ? chosen.x : options.x)),
             y = shown(column(run, options.y.empty() ? chosen.y : options.y));
  text += "\n" + text_plot(x.values, y.values, fmt::format("{} [{}]", x.name, x.unit),
                           fmt::format("{} [{}]", y.name, y.unit), options.plot);
  if (!run.log.empty()) text += "\n";
  for (std::size_t i = run.log.size() - std::min<std::size_t>(3, run.log.size()); i < run.log.size(); ++i)
    text += run.log[i].text + "\n";
  return core::printable(text);
}

} // namespace fissura::report
