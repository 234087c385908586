#include "look.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <sys/ioctl.h>
#include <thread>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/core/printable.hpp"
#include "fissura/report/compare.hpp"
#include "fissura/report/report.hpp"
#include "fissura/report/watch.hpp"
#include "numbers.hpp"
#include "python_tool.hpp"
#include "seconds.hpp"

namespace fissura::app {

using report::RunFolder;

LookCommands::LookCommands(CLI::App& app, std::string version) : version_(std::move(version)) {
  report_ = app.add_subcommand("report", "Write one self-contained HTML page from a run folder");
  report_->add_option("folder", folder_, "Run folder")->required();
  report_->add_option("-o,--out", out_, "File to write (default: report.html in the run folder)");

  picture_ = app.add_subcommand("picture", "Draw the cracks of a run as a PNG");
  picture_->add_option("folder", folder_, "Run folder")->required();
  picture_->add_option("--field", field_, "What colours the cracks: opening, sliding or damage")
      ->check(CLI::IsMember({"opening", "sliding", "damage"}));
  picture_->add_option("--time", time_, "Seconds (the nearest frame), also with a unit, or last");
  picture_->add_option("--warp", warp_, "Factor on the displacements, or auto")
      ->check(number_within(-1e9, 1e9, "auto"));
  picture_->add_option("--up", up_, "Axis that points up: x, y or z")->check(CLI::IsMember({"x", "y", "z"}));
  picture_->add_option("--min-damage", min_damage_, "Joints with less damage are not drawn (default 0.2)")
      ->check(number_within(0, 1));
  picture_
      ->add_option(
          "--from", least_,
          "Cracks narrower than this [mm] are not drawn, or auto: 0.02 mm where the widest is above 0.2 mm")
      ->check(number_within(0, 1e9, "auto"));
  picture_->add_flag("--fragments", fragments_, "Draw the pieces instead of the cracks");
  picture_->add_option("--title", title_, "Default: that of the case");
  picture_->add_option("-o,--out", out_, "PNG to write (default: crack.png in the run folder)");

  plot_ = app.add_subcommand("plot", "Draw columns of history.csv over each other as a PNG");
  plot_->add_option("folder", folder_, "Run folder")->required();
  plot_->add_option("--x", x_, "Column (default: time)");
  plot_->add_option("--y", columns_, "Column; may be given several times")
      ->required()
      ->allow_extra_args(false);
  plot_->add_option("--title", title_, "Default: that of the case");
  plot_->add_flag("--peak", peak_, "Print the largest magnitude of each y");
  plot_->add_option("-o,--out", out_, "PNG to write (default: plot.png in the run folder)");

  compare_ = app.add_subcommand("compare", "Compare the curves of two runs; exits with 1 if they differ");
  compare_->add_option("first", folder_, "Run folder")->required();
  compare_->add_option("second", other_, "Run folder")->required();
  compare_
      ->add_option("--tolerance", tolerance_,
                   "Mean difference over a column's range that is still equal (default 0.02)")
      ->check(number_within(0, 1e9));
  compare_->add_option("--y", columns_, "Columns that decide (default: all gauges)")->allow_extra_args(false);
  compare_->add_option("-o,--out", out_, "Also write an HTML page with the curves over each other");

  watch_ = app.add_subcommand("watch", "Follow a run in progress; ends with it");
  watch_->add_option("folder", folder_, "Run folder")->required();
  watch_->add_option("--x", x_, "Column of the curve (default: a displacement, else time)");
  watch_->add_option("--y", columns_, "Column of the curve (default: a load)")
      ->allow_extra_args(false)
      ->expected(1);
  watch_->add_option("--every", every_, "Seconds between two looks (default 2)")
      ->check(number_within(0.01, 86400));
  watch_->add_flag("--once", once_, "One look, then end");
}

bool LookCommands::asked() const {
  return *report_ || *picture_ || *plot_ || *compare_ || *watch_;
}

int LookCommands::run() const {
  if (*report_) return report();
  if (*picture_) return picture();
  if (*plot_) return plot();
  if (*compare_) return compare();
  return watch();
}

int LookCommands::report() const {
  fmt::print("{}\n", core::printable_line(report::write_report(folder_, {.out = out_, .version = version_})));
  return 0;
}

int LookCommands::picture() const {
  std::string const time = time_ == "last" ? time_ : fmt::format("{}", seconds("--time", time_));
  RunFolder const run(folder_); // its own words for a folder that is none
  std::vector<std::string> words{folder_,
                                 "--field",
                                 field_,
                                 "--time",
                                 time,
                                 "--warp",
                                 warp_,
                                 "--up",
                                 up_,
                                 "--min-damage",
                                 fmt::format("{}", min_damage_),
                                 "--from",
                                 least_,
                                 "--out",
                                 out_.empty() ? folder_ + "/crack.png" : out_};
  if (fragments_) words.push_back("--fragments");
  if (!title_.empty()) words.insert(words.end(), {"--title", title_});
  return run_python_tool("picture.py", words);
}

int LookCommands::plot() const {
  RunFolder const run(folder_);
  std::vector<std::string> words{folder_, "--x", x_, "--out", out_.empty() ? folder_ + "/plot.png" : out_};
  for (auto const& y : columns_) words.insert(words.end(), {"--y", y});
  if (peak_) words.push_back("--peak");
  if (!title_.empty()) words.insert(words.end(), {"--title", title_});
  return run_python_tool("plot_history.py", words);
}

int LookCommands::compare() const {
  RunFolder const first(folder_), second(other_);
  report::CompareOptions const options{.tolerance = tolerance_, .columns = columns_, .version = version_};
  auto const c = report::compare(first, second, options);
  fmt::print("{}", report::comparison_text(c, first, second));
  if (!out_.empty()) {
    report::write_comparison(out_, c, first, second, options);
    fmt::print("{}\n", core::printable_line(out_));
  }
  return c.agree ? 0 : 1;
}

namespace {

bool speaks_utf8() {
  for (char const* name : {"LC_ALL", "LC_CTYPE", "LANG"})
    if (char const* value = std::getenv(name); value && *value) {
      std::string_view const v = value;
      return v.find("UTF-8") != std::string_view::npos || v.find("utf8") != std::string_view::npos;
    }
  return false;
}

/// As wide as the terminal allows.
report::TextPlot plot_size() {
  report::TextPlot size{.dots = speaks_utf8()};
  winsize w{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &w) == 0 && w.ws_col > 30) {
    size.width = std::min(100, w.ws_col - 16);
    size.height = std::clamp(w.ws_row - 12, 6, 20);
  }
  return size;
}

} // namespace

int LookCommands::watch() const {
  bool const terminal = ::isatty(STDOUT_FILENO) != 0;
  report::WatchOptions options;
  if (watch_->count("--x") > 0) options.x = x_;
  if (!columns_.empty()) options.y = columns_.front();
  for (;;) {
    RunFolder const run(folder_);
    options.plot = plot_size();
    std::string const screen = report::watch_screen(run, options);
    if (terminal && !once_) fmt::print("\x1b[H\x1b[J");
    fmt::print("{}", screen);
    std::fflush(stdout);
    if (run.finished()) return run.summary.value("status", "") == "failed" ? 1 : 0;
    if (once_) return 0;
    std::this_thread::sleep_for(std::chrono::duration<double>(every_));
  }
}

} // namespace fissura::app
