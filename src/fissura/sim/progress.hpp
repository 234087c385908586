#pragma once
// The progress line: share done, time left over a moving window, residual, damage.
#include <array>
#include <chrono>
#include <string>

namespace fissura::sim {

class Progress {
 public:
  /// Seconds of wall time left, from the speed of the last half minute or so; < 0 while unknown.
  double eta(double done) { return eta(done, elapsed()); }
  /// The same at a given wall time since the start [s].
  double eta(double done, double wall);
  double elapsed() const;
  /// Tells the share that was done before the first look: of a run that goes on.
  void begin_at(double done) { first_ = done; }
  /// True at most every `seconds` of wall time.
  bool due(double seconds);

 private:
  using clock = std::chrono::steady_clock;
  struct Sample {
    double wall, done;
  };
  clock::time_point start_ = clock::now();
  double last_ = 0, first_ = 0;
  std::array<Sample, 16> window_{};
  std::size_t samples_ = 0;
};

/// What the progress line says.
struct Standing {
  double share = 0;    ///< of the simulated time, 0 to 1
  double time = 0;     ///< reached [s]
  double left = -1;    ///< wall time [s]; < 0 = not known yet
  double residual = 0; ///< of the energy
  int joints_damaged = 0, joints_broken = 0, bars_yielded = 0, bars_broken = 0;
};

/// For a log: everything in one line.
std::string progress_line(Standing const& s);
/// For a terminal `width` characters wide: with a bar, cut off where the line ends; the bar in colour if
/// asked.
std::string progress_bar_line(Standing const& s, int width, bool colour);

/// "1 h 02 min", "3 min 20 s", "12 s".
std::string readable_duration(double seconds);

} // namespace fissura::sim
