#pragma once
// The user's conditions for ending a run.
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "fissura/model/case.hpp"
#include "fissura/sim/gauges.hpp"

namespace fissura::sim {

class Stops {
 public:
  Stops(model::Case const& c, Gauges const& gauges);
  /// The first condition that the present readings meet, in words.
  std::optional<std::string> met(Gauges const& gauges);

  /// What a checkpoint holds.
  static auto fields(auto& self) { return std::tie(self.watches_); }

 private:
  struct Watch {
    model::StopSpec spec;
    int gauge;
    std::string unit;
    std::array<double, 5>
        last{}; ///< the last readings: a load "has fallen" when their mean has, not at a spike
    std::size_t readings = 0;
    double peak = 0; ///< largest |mean| so far

    double mean_with(double reading);
    static auto fields(auto& self) { return std::tie(self.last, self.readings, self.peak); }
  };
  std::vector<Watch> watches_;
};

} // namespace fissura::sim
