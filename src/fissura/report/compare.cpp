#include "fissura/report/compare.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/core/printable.hpp"
#include "fissura/output/atomic_file.hpp"
#include "fissura/report/history_numbers.hpp"
#include "fissura/report/page.hpp"

namespace fissura::report {

using output::Json;
using Column = History::Column;

namespace {

[[noreturn]] void refuse(std::string const& why) {
  throw core::Error(core::Failure::input, why);
}

/// Linear between the rows of a curve; times grow.
double interpolate(std::vector<double> const& times, std::vector<double> const& values, double t) {
  auto const after = std::lower_bound(times.begin(), times.end(), t);
  auto const i = static_cast<std::size_t>(after - times.begin());
  if (i == 0) return values.front();
  if (i == times.size()) return values.back();
  if (times[i] == t) return values[i];
  double const share = (t - times[i - 1]) / (times[i] - times[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

double peak(Column const& c) {
  return *std::max_element(c.values.begin(), c.values.end(),
                           [](double a, double b) { return std::abs(a) < std::abs(b); });
}

ColumnDifference difference(History const& a, History const& b, Column const& first, Column const& second) {
  ColumnDifference d{.name = first.name, .unit = first.unit};
  auto const &times = a.columns.front().values, &other = b.columns.front().values;
  // Over the time that both share: the peaks of a run that goes on longer would make any difference small.
  auto const shared = std::upper_bound(times.begin(), times.end(), other.back()) - times.begin();
  auto const end = first.values.begin() + std::max<std::ptrdiff_t>(shared, 1);
  auto const [low, high] = std::minmax_element(first.values.begin(), end);
  double range = *high - *low;
  if (!(range > 0)) range = std::max(std::abs(*high), std::abs(peak(second)));
  std::size_t rows = 0;
  double sum = 0;
  for (std::size_t i = 0; i < times.size() && times[i] <= other.back(); ++i, ++rows) {
    double const size = std::abs(first.values[i] - interpolate(other, second.values, times[i]));
    sum += size;
    if (size > d.largest) d.largest = size, d.at = times[i];
  }
  if (range > 0 && rows > 0) d.mean = sum / static_cast<double>(rows) / range, d.largest /= range;
  d.peaks = {peak(first), peak(second)};
  return d;
}

/// Columns that belong to the case and not to the program.
std::vector<std::string> gauges_of(RunFolder const& run) {
  std::vector<std::string> names;
  output::Json const deck = describe_deck(run);
  for (auto const& g : deck["gauges"]) names.push_back(g["name"]);
  std::erase_if(names, [&](auto const& n) { return !run.history.find(n); });
  if (!names.empty()) return names;
  for (auto const& c : run.history.columns)
    if (c.name.starts_with("reaction_")) names.push_back(c.name);
  return names;
}

std::string names_of(History const& h) {
  std::string text;
  for (auto const& c : h.columns) text += (text.empty() ? "" : ", ") + c.name;
  return text;
}

void check(RunFolder const& run, std::vector<std::string> const& columns) {
  if (run.history.rows() == 0) refuse(fmt::format("{}: history.csv has no rows yet", run.path()));
  for (auto const& name : columns)
    if (!run.history.find(name))
      refuse(fmt::format("{}: history.csv has no column `{}`; there are: {}", run.path(), name,
                         names_of(run.history)));
}

bool same_state(RunFolder const& a, RunFolder const& b) {
  auto const hash = [](RunFolder const& r) {
    return r.summary.is_object() ? r.summary.value("state_hash", "") : "";
  };
  return !hash(a).empty() && hash(a) == hash(b);
}

std::string verdict_of(Comparison const& c, double ends[2], double tolerance, bool ends_differ, bool same) {
  std::string worst;
  double most = -1;
  long differing = 0, deciding = 0;
  for (auto const& r : c.rows) {
    if (!r.decides) continue;
    ++deciding, differing += r.differs;
    if (r.mean > most) most = r.mean, worst = r.name;
  }
  std::string text = same ? "Both runs end in the same state, to the last bit. " : "";
  if (ends_differ)
    text += fmt::format("The runs end at t = {:.5g} s and {:.5g} s, and so they differ. As far as both go: ",
                        ends[0], ends[1]);
  char const* const column = deciding == 1 ? "column" : "columns";
  text += differing == 0 ? fmt::format("{} {} within {:.3g} % of the range in the mean; the "
                                       "largest difference has `{}`, {:.2g} %.",
                                       deciding, column, 100 * tolerance, worst, 100 * most)
                         : fmt::format("{} of {} {} outside {:.3g} % of the range in the "
                                       "mean; the largest difference has `{}`, {:.2g} %.",
                                       differing, deciding, column, 100 * tolerance, worst, 100 * most);
  return text;
}

} // namespace

Comparison compare(RunFolder const& first, RunFolder const& second, CompareOptions const& options) {
  check(first, options.columns);
  check(second, options.columns);
  auto const deciding = options.columns.empty() ? gauges_of(first) : options.columns;
  Comparison c;
  for (auto const& column : first.history.columns) {
    Column const* other = second.history.find(column.name);
    if (!other || column.name == "time") continue;
    auto d = difference(first.history, second.history, column, *other);
    d.decides = std::find(deciding.begin(), deciding.end(), column.name) != deciding.end();
    d.differs = d.decides && !(d.mean <= options.tolerance); // a NaN differs
    c.rows.push_back(d);
  }
  bool const any = std::any_of(c.rows.begin(), c.rows.end(), [](auto const& r) { return r.decides; });
  if (!any)
    refuse(fmt::format("{} and {} have no reading in common; name columns with --y", first.path(),
                       second.path()));
  double ends[2] = {first.history.columns.front().values.back(),
                    second.history.columns.front().values.back()};
  bool const ends_differ = std::abs(ends[0] - ends[1]) > options.tolerance * std::max(ends[0], ends[1]);
  c.agree =
      !ends_differ && std::none_of(c.rows.begin(), c.rows.end(), [](auto const& r) { return r.differs; });
  c.verdict = verdict_of(c, ends, options.tolerance, ends_differ, same_state(first, second));
  return c;
}

std::string comparison_text(Comparison const& c, RunFolder const& first, RunFolder const& second) {
  std::string text =
      fmt::format("first   {}\nsecond  {}\n\n{:<26} {:>10} {:>10} {:>12} {:>14} {:>14}\n", first.path(),
                  second.path(), "column", "mean", "largest", "at t [s]", "peak, first", "peak, second");
  for (auto const& r : c.rows)
    if (r.decides)
      text += fmt::format("{:<26} {:>8.3g} % {:>8.3g} % {:>12.5g} {:>14.6g} {:>14.6g}{}\n",
                          fmt::format("{} [{}]", r.name, r.unit), 100 * r.mean, 100 * r.largest, r.at,
                          r.peaks[0], r.peaks[1], r.differs ? "  differs" : "");
  return core::printable(text + fmt::format("\n{}\n{}\n", c.verdict, c.agree ? "agree" : "differ"));
}

void write_comparison(std::string const& path, Comparison const& c, RunFolder const& first,
                      RunFolder const& second, CompareOptions const& options) {
  require_page();
  Blob blob;
  blob.meta["kind"] = "comparison";
  blob.meta["version"] = options.version;
  blob.meta["written"] = local_time();
  bool const alike = first.name() == second.name();
  blob.meta["names"] = {alike ? first.path() : first.name(), alike ? second.path() : second.name()};
  blob.meta["agree"] = c.agree;
  blob.meta["verdict"] = c.verdict;
  blob.meta["tolerance"] = options.tolerance;
  blob.meta["gauges"] = describe_deck(first)["gauges"];
  blob.meta["rows"] = Json::array();
  for (auto const& r : c.rows)
    blob.meta["rows"].push_back({{"name", r.name},
                                 {"unit", r.unit},
                                 {"mean", r.mean},
                                 {"largest", r.largest},
                                 {"at", r.at},
                                 {"peaks", r.peaks},
                                 {"differs", r.differs}});
  add_history(blob, "a", first.history);
  add_history(blob, "b", second.history);
  output::replace_file(path, fill_page(fmt::format("{} and {}", first.name(), second.name()), blob.text()));
}

} // namespace fissura::report
