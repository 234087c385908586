#pragma once
// Watches the readings of the energy ledger: residual, kinetic share, equilibrium.
#include <optional>
#include <tuple>
#include <vector>

#include "fissura/concrete/concrete.hpp"
#include "fissura/rebar/rebar.hpp"
#include "fissura/sim/inertia.hpp"
#include "fissura/sim/trouble.hpp"
#include "fissura/step/ledger.hpp"

namespace fissura::sim {

struct BarCounts {
  int activated = 0, yielded = 0, broken = 0; ///< bar joints
};
BarCounts count_bars(state::BarState const& bars);

class Monitor {
 public:
  explicit Monitor(model::Model const& m);

  /// Takes in a reading of the ledger. Returns the reason to stop the run, if there is one.
  std::optional<Trouble> take(step::EnergyBalance const& e, model::Model const& m, state::State const& s);

  /// Largest |missing energy| so far over the largest energy put in so far; negative = energy was created.
  double residual() const { return scale_ > 0 ? worst_missing_ / scale_ : 0; }
  /// Residual of one reading.
  double residual_of(step::EnergyBalance const& e) const { return scale_ > 0 ? e.missing() / scale_ : 0; }
  /// Largest kinetic/internal energy while the internal energy was above 1 % of its largest value.
  double kinetic_ratio() const;
  /// How much inertia took part so far.
  Inertia inertia() const { return judge_inertia(readings_); }
  /// Resultant over half the sum of the forces, of the last reading alone: 0 = equilibrium.
  double last_imbalance() const { return last_imbalance_; }
  bool crossed_warning() const { return warned_; }

  /// What a checkpoint holds.
  static auto fields(auto& self) {
    return std::tie(self.worst_missing_, self.scale_, self.last_imbalance_, self.warned_, self.readings_);
  }

 private:
  static Trouble unbalanced(double residual, model::Model const& m, state::State const& s);
  static void weigh_forces(Reading& reading, model::Model const& m, state::State const& s);
  double worst_missing_ = 0, scale_ = 0, floor_ = 0;
  double last_imbalance_ = 0;
  bool warned_ = false, any_paper_ = false;
  std::vector<Reading> readings_;
};

} // namespace fissura::sim
