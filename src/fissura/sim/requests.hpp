#pragma once
// What may ask a run to stop or to show itself: a signal, the wall time, a file in the run folder.
#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "fissura/core/error.hpp"

namespace fissura::sim {

/// A signal that came before the first step: nothing has been written.
class Interrupted : public core::Error {
 public:
  explicit Interrupted(std::string const& reason) : Error(core::Failure::run, reason) {}
};

class Requests {
 public:
  /// `signal` returns the number of a signal that has come, or 0; may be empty. `walltime` [s] counts from
  /// now; an empty folder has no files.
  Requests(std::function<int()> signal, std::optional<double> walltime);
  void watch(std::string const& folder) { folder_ = folder; }

  /// The reason to stop, if there is one. Cheap enough for every step: files are looked for at most every 10
  /// ms. A file `stop` is removed.
  std::optional<std::string> to_stop();
  /// To be called now and then before the first step: throws Interrupted once a signal has come.
  void check_signal() const;
  /// Whether a file `output_now` was found; it is removed.
  bool for_output();

 private:
  using clock = std::chrono::steady_clock;
  void look_for_files();
  bool take(char const* file) const;
  std::function<int()> signal_;
  std::optional<double> walltime_;
  std::string folder_;
  clock::time_point start_ = clock::now(), next_look_ = start_;
  bool stop_ = false, output_ = false;
};

} // namespace fissura::sim
