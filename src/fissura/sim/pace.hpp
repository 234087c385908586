#pragma once
// Quasi-static pace control: the loads follow their curves as fast as the kinetic energy allows.
#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

/// The kinetic energy of a slowly driven structure grows with the square of the pace. So the pace that would
/// bring kinetic over internal energy to [run] `pace_kinetic` is known at every reading of the ledger; the
/// loads approach it within 20 transits of a wave through the structure from below, ten times faster from
/// above (a crack that runs sets tets in motion). Between 1 and [run] `pace`.
class PaceControl {
 public:
  explicit PaceControl(model::Model const& m);

  bool is_on() const { return most_ > 1; }
  /// At a reading: sets State::pace_growth for the steps to the next one.
  void steer(double kinetic, double internal, state::State& s) const;

 private:
  double most_, kinetic_ratio_;
  double steps_to_next_;
  double rise_; ///< growth of ln(pace) per step at most
};

} // namespace fissura::sim
