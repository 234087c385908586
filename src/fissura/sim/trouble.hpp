#pragma once
// What ends a run that has gone wrong: where, when, why, and what to do about it.
#include <string>

#include "fissura/core/error.hpp"
#include "fissura/core/vec3.hpp"

namespace fissura::sim {

/// A part of the model that a message names; ids are those of the input where the input has some.
struct Spot {
  std::string what;  ///< "tet 17 of group beam", "joint 4 between tets 3 and 9", "bar `long`, copy 1, ..."
  std::string field; ///< what is wrong there: "velocity"; empty where the place itself is
  std::string group; ///< volume group or name of the bar; empty where there is none
  int tet = -1;      ///< input number of a tet there; -1 = none
  bool has_place = false;
  Vec3 at; ///< centroid at t = 0 [m], if has_place
};

/// "the velocity of tet 17 of group beam at (0.1, 0, 2) m".
std::string describe(Spot const& spot);

/// Why a run ends with status failed.
struct Trouble {
  std::string kind; ///< not_finite, inverted_tet, runaway, energy
  std::string what; ///< one clause: what was found
  Spot spot;
  double time = 0; ///< [s]
  long step = 0;
  std::string cause, cure; ///< likely ones
};

/// One line for the terminal, the log and `reason` of run.json.
std::string describe(Trouble const& trouble);

class RunFailure : public core::Error {
 public:
  explicit RunFailure(Trouble t) : Error(core::Failure::run, describe(t)), trouble(std::move(t)) {}
  Trouble trouble;
};

} // namespace fissura::sim
