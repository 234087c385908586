#pragma once
// What a bar remembers under cyclic load; one layout for every steel law.
#include "fissura/laws/branch_memory.hpp"

namespace fissura::laws {

struct SteelHistory {
  double strain = 0, stress = 0; ///< last evaluation [-], [Pa]
  Branch now;                    ///< what the bar follows
  BranchList rising, falling;    ///< what it may come back to
  double eps_largest = 0;        ///< largest strain so far; Kato's: beyond yield, as it was then; 0: never
  double eps_smallest = 0;       ///< smallest strain so far; Menegotto-Pinto's only
  double eps_z = -1e30;          ///< largest strain at which unloading crosses zero stress; Kato's only
  int direction = 0;             ///< +1 rising strain, -1 falling, 0 at the start
  bool ruptured = false;
};

} // namespace fissura::laws
