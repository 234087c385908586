#pragma once
// A run folder as it lies on the disk, finished or still growing (docs/reference/outputs.md).
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "fissura/output/json.hpp"

namespace fissura::report {

/// history.csv: columns of equal length. A last line without its end is left out.
struct History {
  struct Column {
    std::string name, unit;
    std::vector<double> values;
  };
  std::vector<Column> columns;

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
  /// The column of this name (without its unit), or nullptr.
  Column const* find(std::string_view name) const;
};

/// One moment of a PVD list.
struct Frame {
  double time = 0; ///< [s]
  std::string file;
};

/// A line of log.txt without its date.
struct LogLine {
  std::string level, text;
};

class RunFolder {
 public:
  /// Reads what is there. Throws core::Error(Failure::io) if the folder is missing, is no run folder (neither
  /// history.csv nor run.json), or holds a file that is not what its name says.
  explicit RunFolder(std::string path);

  std::string const& path() const { return path_; }
  /// Last part of the path, the name a reader knows it by.
  std::string name() const;
  bool finished() const { return !summary.is_null(); }

  output::Json summary; ///< run.json; null while the run goes on
  History history;
  std::map<std::string, std::vector<Frame>> frames; ///< by kind: fields, cracks, bars, rigid
  std::vector<LogLine> log;
  std::string deck; ///< case.toml, the echo; empty if there is none

 private:
  std::string path_;
};

/// The parts of a run folder, one by one; a missing file gives nothing.
History read_history(std::string const& path);
std::vector<Frame> read_frames(std::string const& path);
std::vector<LogLine> read_log(std::string const& path);

} // namespace fissura::report
