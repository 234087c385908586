#pragma once
// Forces on the corners of the few tets that bars, contact or applied loads act on. A tet without a slot
// costs nothing. The first slots belong to the tets that bars and loads act on (Model::overlay_tets); contact
// adds more as it spreads, between two steps.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fissura/core/node_field.hpp"

namespace fissura::state {

struct Overlay {
  std::vector<int> tets;              ///< the tets that own a slot
  std::vector<int> slot_of_tet;       ///< per tet, padded to blocks: its slot, or -1
  std::vector<std::uint8_t> in_block; ///< per block of 8 tets: some tet of it owns a slot
  std::vector<double> force;          ///< [slot][corner][x y z], N

  Overlay() = default;
  /// Slots for `first_tets`, in their order, out of `padded` tets (a multiple of 8).
  Overlay(std::size_t padded, std::vector<int> const& first_tets)
      : slot_of_tet(padded, -1), in_block(padded / 8, 0) {
    for (int const tet : first_tets) slot_for(tet);
  }

  /// The slot of a tet; makes one if it has none (allocates: never within the force passes).
  int slot_for(int tet) {
    int& slot = slot_of_tet[static_cast<std::size_t>(tet)];
    if (slot >= 0) return slot;
    slot = static_cast<int>(tets.size());
    tets.push_back(tet);
    in_block[static_cast<std::size_t>(tet) / 8] = 1;
    force.resize(core::per_tet * tets.size(), 0.0);
    return slot;
  }

  void clear() { std::fill(force.begin(), force.end(), 0.0); }
  double* at(int slot) { return force.data() + core::per_tet * slot; }
  double const* at(int slot) const { return force.data() + core::per_tet * slot; }
};

} // namespace fissura::state
