#pragma once
// The user's conditions for ending a run.
#include <optional>
#include <string>
#include <vector>

#include "fissura/model/case.hpp"
#include "fissura/sim/gauges.hpp"

namespace fissura::sim {

class Stops {
 public:
  Stops(model::Case const& c, Gauges const& gauges);
  /// The first condition that the present readings meet, in words.
  std::optional<std::string> met(Gauges const& gauges);

 private:
  struct Watch {
    model::StopSpec spec;
    int gauge;
    double peak = 0; ///< largest |reading| so far
  };
  std::vector<Watch> watches_;
};

} // namespace fissura::sim
