#include "fissura/sim/progress.hpp"

#include <algorithm>
#include <fmt/format.h>

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

std::string readable_duration(double seconds) {
  long const s = static_cast<long>(seconds + 0.5);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

} // namespace fissura::sim
