#pragma once
// When something is due during a run.

namespace fissura::sim {

/// Fires at times 0, every, 2 every, ... (and never if every <= 0).
class Due {
 public:
  explicit Due(double every) : every_(every) {}
  bool at(double time) const { return every_ > 0 && time >= next_ * (1 - 1e-12); }
  void done(double time) {
    while (next_ <= time * (1 + 1e-12)) next_ = every_ * static_cast<double>(++count_);
  }

  /// What a checkpoint holds: how often it has fired. The rest follows from that.
  long count() const { return count_; }
  void set_count(long count) {
    count_ = count;
    next_ = every_ * static_cast<double>(count_);
  }

 private:
  double every_, next_ = 0;
  long count_ = 0;
};

} // namespace fissura::sim
