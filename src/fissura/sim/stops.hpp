#pragma once
// The user's conditions for ending a run.
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "fissura/model/case.hpp"
#include "fissura/sim/gauges.hpp"
#include "fissura/sim/old_history.hpp"

namespace fissura::sim {

/// What a checkpoint holds of a condition.
struct SavedStop {
  std::string definition; ///< its keys in the deck and those of its gauge
  std::array<double, 5>
      last{}; ///< the last readings: a load "has fallen" when their mean has, not at a spike
  std::size_t readings = 0;
  double peak = 0; ///< largest |mean| so far
  using ListGrows = void;
  static auto fields(auto& self) { return std::tie(self.definition, self.last, self.readings, self.peak); }
};

class Stops {
 public:
  Stops(model::Case const& c, Gauges const& gauges);
  /// The first condition that the present readings meet, in words.
  std::optional<std::string> met(Gauges const& gauges);

  std::vector<SavedStop> saved() const;
  /// Goes on from a checkpoint, maybe with other conditions; those that are new look at the rows of the
  /// history so far. Throws core::InputError at one that they have met. True if all are as they were.
  bool go_on_from(std::vector<SavedStop> const& saved, OldHistory const& old, Gauges const& gauges);

 private:
  struct Watch {
    model::StopSpec spec;
    int gauge;
    std::string unit;
    SavedStop memory;

    std::optional<std::string> met(double reading);
    double mean_with(double reading);
  };
  void look_back(Watch& watch, OldHistory const& old, Gauges const& gauges) const;
  std::vector<Watch> watches_;
};

} // namespace fissura::sim
