#pragma once
// The report page of a run: now and then while it goes on, and once it has ended.
#include <string>

namespace fissura::sim {

class Log;

class ReportWriter {
 public:
  /// `wanted` false, or an empty folder: nothing is ever written.
  ReportWriter(std::string folder, std::string version, bool wanted);

  /// Writes the page of what has been saved so far, if it is due at this wall time since the start [s]: first
  /// after 20 s, then so seldom that pages take at most a fiftieth of the time, and a minute apart or more.
  void meanwhile(double elapsed, Log& log);
  /// Writes the page of the whole run. A page that cannot be written is a warning: the run is what counts.
  void at_end(Log& log);

 private:
  bool write(Log& log);
  std::string folder_, version_;
  bool wanted_;
  double next_ = 20; ///< [s]
};

} // namespace fissura::sim
