#pragma once
// When the next stage of the loads begins, and when the last one is over.
#include <tuple>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

/// When the run ends, in the time of its loads, if no stage settles early [s].
double planned_end(model::Model const& m);

class Stages {
 public:
  explicit Stages(model::Model const& m);

  /// When the stages end, as far as known, in load time [s]; an `end_time` of the deck stands.
  double end() const { return end_; }

  /// Whether the present stage has lasted its time and another one follows.
  bool is_over(model::Model const& m, state::State const& s) const;

  /// To be asked at each reading of the energies, and when a stage is over: begins the next stage if the
  /// present one has lasted its time or has settled (`is_quiet` three times in a row while no load is on its
  /// way). True if one has begun.
  bool go_on(model::Model const& m, state::State& s, bool is_quiet);

  /// Goes on from a checkpoint, maybe with another `end_time` or length of the last stage.
  void go_on_from(model::Model const& m, state::State const& s);

  /// What a checkpoint holds.
  static auto fields(auto& self) { return std::tie(self.end_, self.settled_); }

 private:
  double end_;
  int settled_ = 0; ///< quiet readings in a row
};

} // namespace fissura::sim
