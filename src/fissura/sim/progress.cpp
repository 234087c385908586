#include "fissura/sim/progress.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "fissura/report/text_plot.hpp"

namespace fissura::sim {

double Progress::elapsed() const {
  return std::chrono::duration<double>(clock::now() - start_).count();
}

bool Progress::due(double seconds) {
  double const now = elapsed();
  if (now - last_ < seconds) return false;
  last_ = now;
  return true;
}

double Progress::eta(double done, double wall) {
  Sample const now{wall, done};
  std::size_t const size = window_.size();
  Sample const oldest = samples_ == 0     ? Sample{0, first_}
                        : samples_ < size ? window_[0]
                                          : window_[samples_ % size];
  window_[samples_++ % size] = now;
  if (now.done <= oldest.done || now.wall <= oldest.wall) return -1;
  return std::max(0.0, (1 - now.done) * (now.wall - oldest.wall) / (now.done - oldest.done));
}

std::string progress_line(Standing const& s) {
  return fmt::format(
      "{:5.1f} %  t = {:.4g} s  left {}  residual {:+.2g} %  joints damaged {} broken {}  bars yielded {} "
      "broken {}",
      100 * s.share, s.time, s.left < 0 ? "?" : readable_duration(s.left), 100 * s.residual, s.joints_damaged,
      s.joints_broken, s.bars_yielded, s.bars_broken);
}

std::string progress_bar_line(Standing const& s, int width, bool colour) {
  int const bar = std::clamp(width / 4, 8, 30);
  std::string text = progress_line(s);
  auto const room = static_cast<std::size_t>(std::max(0, width - bar - 4));
  if (text.size() > room) text.resize(room); // a line that wraps cannot be written over
  std::string const filled = report::progress_bar(s.share, bar);
  std::size_t const done = filled.find_last_of('#') + 1; // npos + 1 = 0
  return fmt::format("[{}{}{}{}] {}", colour ? "\x1b[36m" : "", filled.substr(0, done),
                     colour ? "\x1b[0m" : "", filled.substr(done), text);
}

std::string readable_duration(double seconds) {
  constexpr double year = 365.25 * 24 * 3600;
  if (!std::isfinite(seconds)) return "an unknown time";
  if (seconds > 10 * year) return fmt::format("{:.2g} years", seconds / year);
  long const s = static_cast<long>(seconds + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

} // namespace fissura::sim
