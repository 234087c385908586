#pragma once
// Who is still joined to whom. Tets hold together through faces without joints and through joints whose faces
// have not parted: intact, damaged, or a crack-face pair that still carries its own compression and friction.
#include <vector>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::contact {

struct Linkage {
  int bodies = 1;
  std::vector<int> body; ///< per tet
  std::vector<int>
      around_point; ///< [tet][4]: tets joined to each other around a mesh point have the same label
};

/// Whether a shared face still holds its two tets together.
bool holds(model::Model const& m, state::State const& s, std::size_t shared_face);

Linkage find_linkage(model::Model const& m, state::State const& s);

/// Tets that share a mesh point and are still joined around it do not see each other, unless their common
/// face itself has parted.
bool are_linked(model::Model const& m, state::State const& s, Linkage const& linkage, int tet_a, int tet_b);

/// Tets with a face that is free: on the boundary, or parted; ascending.
std::vector<int> surface_tets(model::Model const& m, state::State const& s);

} // namespace fissura::contact
