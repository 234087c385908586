#pragma once
// The checkpoints of a run: numbered files in RUN/checkpoints, of which the last two are kept.
#include <functional>
#include <string>

#include "fissura/checkpoint/archive.hpp"

namespace fissura::checkpoint {

class Store {
 public:
  /// Makes RUN/checkpoints if need be. Throws core::Error(Failure::io), here and below.
  explicit Store(std::string const& run_folder);

  /// Writes the next number, then removes all but the last two. Returns the path.
  std::string write(std::function<void(Saver&)> const& contents);
  /// The newest one, or "".
  std::string last() const;
  /// Takes a copy of a checkpoint of another run as the next number.
  void adopt(std::string const& path);
  /// Removes what is newer than `path`, which is one of this store, and what a killed run has left half
  /// written.
  void cut_back_to(std::string const& path);

 private:
  std::string path_of(long number) const;
  std::string folder_;
  long last_ = 0;
};

/// The checkpoint that `place` means: itself if it is a file, else the newest one of that run folder. Throws
/// core::InputError if there is none.
std::string find(std::string const& place);
/// RUN of RUN/checkpoints/FILE. Throws core::InputError if the file lies elsewhere.
std::string run_folder_of(std::string const& path);

} // namespace fissura::checkpoint
