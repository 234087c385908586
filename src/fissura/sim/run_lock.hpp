#pragma once
// A run folder in use: a file `.lock` in it that the system itself holds for the run, and lets go when the
// program ends, however it ends. What a killed program leaves behind keeps nobody out.
#include <string>

namespace fissura::sim {

class RunLock {
 public:
  RunLock() = default; ///< holds nothing
  /// Takes the folder, which exists. Throws core::Error(Failure::io) if a run is at work in it (naming that),
  /// or if the file cannot be made.
  explicit RunLock(std::string const& folder);
  /// Lets the folder go as it was: without the file, or with what a killed run had left in it.
  ~RunLock();
  RunLock(RunLock&& other) noexcept;
  RunLock& operator=(RunLock&& other) noexcept;

  bool holds() const { return descriptor_ >= 0; }
  /// Lets the folder go and takes the file away, at the end of a run. Throws core::Error(Failure::io) for
  /// what the system could not keep.
  void release();
  /// Why this file system keeps nobody out; empty where it does.
  std::string const& doubt() const { return doubt_; }

  /// Whether a killed run has left its file in the folder.
  static bool was_left_in(std::string const& folder);

 private:
  bool try_once();
  std::string path_, doubt_, found_;
  int descriptor_ = -1;
};

} // namespace fissura::sim
