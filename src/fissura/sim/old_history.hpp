#pragma once
// The history.csv that a restart goes on with: read and checked before anything is touched. Its columns may
// be others than those of the file: what a gauge was not asked before the restart reads nan.
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "fissura/output/csv.hpp"

namespace fissura::sim {

/// How long the history was when a checkpoint was written.
struct HistoryMark {
  std::uint64_t bytes = 0;
  std::int64_t rows = 0;
  std::string header; ///< its first line
  static auto fields(auto& self) { return std::tie(self.bytes, self.rows, self.header); }
};

struct OldHistory {
  std::uint64_t bytes = 0;      ///< of the file to go on with; what is behind them is cut off
  std::vector<double> rows;     ///< row after row, each as long as the columns (the time first)
  std::string text;             ///< the file as it must be; empty where it is that already
  std::size_t column_count = 0; ///< with the time
};

/// What the file holds up to the mark, in `columns` (without the time). `is_new[i]`: the i-th of them was not
/// there before the checkpoint, whatever its name. Throws core::InputError if the file is shorter than the
/// mark says, has other columns than were written then, or rows that are not whole;
/// core::Error(Failure::io) if it cannot be read.
OldHistory read_old_history(std::string const& path, HistoryMark const& mark,
                            std::vector<output::Column> const& columns, std::vector<bool> const& is_new);

} // namespace fissura::sim
