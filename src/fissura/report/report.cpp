#include "fissura/report/report.hpp"

#include <algorithm>
#include <fmt/core.h>

#include "fissura/output/atomic_file.hpp"
#include "fissura/report/history_numbers.hpp"
#include "fissura/report/page.hpp"
#include "fissura/report/scene.hpp"

namespace fissura::report {

using output::Json;

namespace {

/// What build and run said: warnings with their cures, notes, and the line that says how it ended.
void add_log(Json& meta, std::vector<LogLine> const& log) {
  meta["warnings"] = Json::array();
  meta["log"] = Json::array();
  for (auto const& line : log) {
    if (line.level == "warning" || line.level == "error") meta["warnings"].push_back(line.text);
    meta["log"].push_back({line.level, line.text});
  }
}

std::string title_of(RunFolder const& run, Json const& deck) {
  for (Json const& from : {run.summary, deck})
    if (from.is_object() && from.contains("title") && !from["title"].get<std::string>().empty())
      return from["title"];
  return run.name();
}

} // namespace

Blob report_numbers(RunFolder const& run, ReportOptions const& options) {
  Blob blob;
  Json const deck = describe_deck(run);
  blob.meta["kind"] = "report";
  blob.meta["version"] = options.version;
  blob.meta["title"] = title_of(run, deck);
  blob.meta["folder"] = run.name();
  blob.meta["written"] = local_time();
  blob.meta["run"] = run.summary;
  blob.meta["deck"] = deck;
  blob.meta["deck_text"] = run.deck;
  add_log(blob.meta, run.log);
  add_history(blob, "history", run.history);
  // Of the page's size a megabyte is program; base64 adds a third, and compression takes at least as much
  // away.
  add_scene(blob, run, (options.megabytes - std::min<std::size_t>(options.megabytes, 2)) * 1000000);
  return blob;
}

std::string report_page(std::string const& folder, ReportOptions const& options) {
  require_page();
  Blob const numbers = report_numbers(RunFolder(folder), options);
  return fill_page(numbers.meta["title"].get<std::string>(), numbers.text());
}

std::string write_report(std::string const& folder, ReportOptions const& options) {
  std::string const out = options.out.empty() ? folder + "/report.html" : options.out;
  output::replace_file(out, report_page(folder, options));
  return out;
}

} // namespace fissura::report
