#pragma once
// The curves of a run as text (history.csv): one header line with units, one row per reading, nothing that
// differs between two runs of the same case.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace fissura::output {

struct Column {
  std::string name;
  std::string unit; ///< "mm", "N"; "-" without dimension
};

/// The first line of such a file.
std::string csv_header(std::vector<Column> const& columns);

class CsvWriter {
 public:
  /// Creates (empties) the file and writes `time [s],<name> [<unit>],...`; names are quoted where they must
  /// be. Throws core::Error(Failure::io) with path and reason, here and below.
  CsvWriter(std::string path, std::vector<Column> const& columns);
  /// Goes on with a file after its first `bytes`; what is behind them is cut off. Throws core::InputError if
  /// the file is shorter, has other columns, or has no line that ends there.
  CsvWriter(std::string path, std::vector<Column> const& columns, std::uint64_t bytes);
  ~CsvWriter();
  CsvWriter(CsvWriter const&) = delete;
  CsvWriter& operator=(CsvWriter const&) = delete;

  /// Appends one row in one write, so that a reader sees whole lines: the shortest digits that read back as
  /// the same doubles. Throws core::Error(Failure::run) if the number of values is not that of the columns.
  void row(double time, std::span<double const> values);

  /// Length of the file.
  std::uint64_t bytes() const { return bytes_; }
  /// Flushes to the disk.
  void flush();
  /// Flushes to the disk and closes; a later row() is an error. Call it at the end: the destructor cannot
  /// report.
  void close();

 private:
  std::string path_;
  std::size_t columns_;
  std::uint64_t bytes_ = 0;
  int descriptor_ = -1;
  std::string line_; ///< kept between rows: no allocation after the first
};

} // namespace fissura::output
