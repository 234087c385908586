#pragma once
// `fissura compare`: the curves of two runs against each other.
#include <array>
#include <string>
#include <vector>

#include "fissura/report/blob.hpp"
#include "fissura/report/run_folder.hpp"

namespace fissura::report {

struct CompareOptions {
  double tolerance = 0.02;          ///< of a column's range, for the mean difference
  std::vector<std::string> columns; ///< those that decide; empty = all gauges
  std::string version;
};

/// One column of both histories. Differences are shares of the range of the first run's column.
struct ColumnDifference {
  std::string name, unit;
  double mean = 0, largest = 0;
  double at = 0;                 ///< time of the largest difference [s]
  std::array<double, 2> peaks{}; ///< largest magnitude in each run, with its sign
  bool decides = false, differs = false;
};

struct Comparison {
  std::vector<ColumnDifference> rows; ///< in the order of the first history
  bool agree = false;
  std::string verdict; ///< one sentence
};

/// Compares over the time both runs have, at the rows of the first one; the second is interpolated. Runs that
/// end at times further apart than the tolerance differ. Throws core::Error(Failure::input) for a column that
/// is missing, or where there is nothing to compare.
Comparison compare(RunFolder const& first, RunFolder const& second, CompareOptions const& options);

/// The differences as a table for the terminal.
std::string comparison_text(Comparison const& c, RunFolder const& first, RunFolder const& second);

/// The page with both runs' curves over each other; throws as write_report().
void write_comparison(std::string const& path, Comparison const& c, RunFolder const& first,
                      RunFolder const& second, CompareOptions const& options);

} // namespace fissura::report
