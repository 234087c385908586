#pragma once
// Forces on the corners of the few tets that bars, contact or applied loads act on. A tet without a slot
// costs nothing.
#include <algorithm>
#include <vector>

namespace fissura::state {

struct Overlay {
  std::vector<int> tets;        ///< the tets that own a slot, ascending
  std::vector<int> slot_of_tet; ///< per tet: its slot, or -1
  std::vector<double> force;    ///< [slot][corner][x y z 0], N

  void clear() { std::fill(force.begin(), force.end(), 0.0); }
  double* at(int slot) { return force.data() + 16 * slot; }
  double const* at(int slot) const { return force.data() + 16 * slot; }
};

} // namespace fissura::state
