#pragma once
// `fissura watch`: a run in progress as a screen of text.
#include <string>

#include "fissura/report/run_folder.hpp"
#include "fissura/report/text_plot.hpp"

namespace fissura::report {

struct WatchOptions {
  std::string x, y; ///< columns of the curve; empty = chosen as the report does
  TextPlot plot;
};

/// Title, share done, the last readings, the curve, and what the log said last. Throws
/// core::Error(Failure::input) for a column that is missing.
std::string watch_screen(RunFolder const& run, WatchOptions const& options);

/// The end of the run as its log forecast it [s]; 0 if it does not say.
double planned_end(RunFolder const& run);

/// Column names of the main curve: a load over a displacement where there are such gauges, else over time.
struct MainPair {
  std::string x, y;
};
MainPair main_pair(RunFolder const& run);

} // namespace fissura::report
