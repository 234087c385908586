#pragma once
// When something is due during a run.
#include <cmath>
#include <tuple>

namespace fissura::sim {

/// Fires at times 0, every, 2 every, ... (and never if every <= 0).
class Due {
 public:
  explicit Due(double every) : every_(every) {}
  bool at(double time) const { return every_ > 0 && time >= next_ * (1 - 1e-12); }
  void done(double time) {
    while (next_ <= time * (1 + 1e-12)) next_ = every_ * static_cast<double>(++count_);
  }

  /// Goes on as a checkpoint says: `every` as it was then and how often it had fired, at `time`. Another
  /// `every` now counts from that time on. False if the numbers cannot be.
  bool go_on(Due const& saved, double time) {
    double const times = every_ > 0 ? time / every_ : 0;
    if (saved.count_ < 0 || !(std::abs(times) < 1e15)) return false;
    count_ = every_ == saved.every_ ? saved.count_ : static_cast<long>(std::ceil(times * (1 - 1e-12)));
    next_ = every_ * static_cast<double>(count_);
    return true;
  }
  /// What a checkpoint holds; the rest follows from that.
  static auto fields(auto& self) { return std::tie(self.count_, self.every_); }

 private:
  double every_, next_ = 0;
  long count_ = 0;
};

} // namespace fissura::sim
