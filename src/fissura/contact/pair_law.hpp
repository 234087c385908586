#pragma once
// The law of one pair of overlapping tets: the potential of tet_overlap.hpp and Coulomb friction at the
// middle of the overlap, with a tangential spring k_t = 2/7 k_n that remembers its stretch.
#include <array>

#include "fissura/contact/tet_overlap.hpp"
#include "fissura/state/contact_state.hpp"

namespace fissura::contact {

/// Tangential over normal stiffness.
inline constexpr double tangential_share = 2.0 / 7.0;

/// What one step needs of a pair beside its memory.
struct PairNow {
  TetNow a, b;
  std::array<Vec3, 4> step_a, step_b; ///< displacements of the corners over the last step [m]
};

struct PairResult {
  state::ContactScratch::PairForce force; ///< on the corners [N]
  double stored = 0;                      ///< potential and spring [J]
  double lost = 0;                        ///< to friction over the last step [J]
};

/// Evaluates the law and moves the memory on. A pair that overlaps when it is first looked at (an imperfect
/// mesh, or faces that have just parted) starts without a force: the energy of that overlap is subtracted,
///   E = (sqrt(E_overlap) - sqrt(E_start))^2,
/// and E_start is forgotten as the overlap vanishes.
PairResult pair_law(state::ContactScratch::PairConstants const& constants, PairNow const& now,
                    state::ContactPair& memory);

} // namespace fissura::contact
