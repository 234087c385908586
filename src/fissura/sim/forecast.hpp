#pragma once
// What a case will cost, measured on the case itself.
#include <vector>

#include "fissura/model/model.hpp"

namespace fissura::sim {

/// Seconds of wall time of one step.
struct StepTime {
  double undisturbed = 0; ///< as fast as this machine has been: what other programs take is left out
  double now = 0;         ///< with all that runs on this machine beside it
};

/// From the wall times of pieces of so many steps each.
StepTime step_time(std::vector<double> const& seconds, int steps_each);

/// Steps the real problem from its start for a fraction of a second.
StepTime measure_step(model::Model const& m);

/// Bytes.
struct Storage {
  double memory = 0;     ///< at the peak, the program and its libraries included
  double disk = 0;       ///< frames and history
  double checkpoint = 0; ///< one of them; two are kept at most
  double frames = 0;     ///< how many
};

/// After measure_step, which has used nearly all the memory that a run will.
Storage measure_storage(model::Model const& m);

} // namespace fissura::sim
