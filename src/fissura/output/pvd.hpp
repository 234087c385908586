#pragma once
// The list of frames of a run (.pvd), which ParaView opens as one data set in time.
#include <string>
#include <utility>
#include <vector>

namespace fissura::output {

class PvdWriter {
 public:
  explicit PvdWriter(std::string path) : path_(std::move(path)) {}

  /// Adds the frame at `time` [s] and rewrites the list at once, whole or not at all. Several files of one
  /// frame become its parts 0, 1, ... File names are relative to the folder of the list. Throws
  /// core::Error(Failure::io).
  void add(double time, std::vector<std::string> const& files);
  /// Goes on with a list of frames of one file each.
  void start_with(std::vector<std::pair<double, std::string>> const& frames);

 private:
  void rewrite() const;
  struct Entry {
    double time;
    int part;
    std::string file;
  };
  std::string path_;
  std::vector<Entry> entries_;
};

} // namespace fissura::output
