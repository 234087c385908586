#pragma once
// What changes in time in the contact between deformable bodies, and the work arrays of its pass.
#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "fissura/core/buffer.hpp"
#include "fissura/core/vec3.hpp"

namespace fissura::state {

/// Two tets that are near each other and not joined; a < b.
struct ContactPair {
  int a = -1, b = -1;
  double energy_at_start = -1; ///< of the overlap that carries no force [J]; -1: not yet looked at
  double stiffness = 0;        ///< of the tangential spring one step ago [N/m]
  Vec3 stretch;                ///< of the tangential spring: b relative to a [m]
};

struct ContactState {
  std::vector<ContactPair> pairs; ///< sorted by (a, b)
  double stored = 0;              ///< energy of the pairs at u_n [J]
  double travel = 0; ///< how far a surface node may have got by the next look, since the last search [m]
  double skin = 0;   ///< distance within which pairs are listed [m]
  std::uint8_t is_due = 1; ///< faces came free since the last refresh (set from several threads)
};

/// Work arrays of contact.
struct ContactScratch {
  struct PairConstants {
    double stiffness; ///< of the overlap's potential [Pa/m]
    double friction;  ///< mu
  };
  struct PairForce {
    std::array<Vec3, 4> on_a{}, on_b{}; ///< on the corners [N]
    bool acts = false;
  };
  /// One pair that acts on a host tet.
  struct Entry {
    int pair;
    bool is_a;
  };
  struct Host {
    int tet, slot, begin, end; ///< entries[begin .. end)
  };
  std::vector<PairConstants> constants; ///< per pair
  std::vector<PairForce> force;         ///< per pair
  std::vector<std::uint8_t> separator;  ///< per pair: the face that lay between the two tets last
  std::vector<Host> hosts;              ///< by tet
  std::vector<Entry> entries;
  std::vector<int> surface; ///< tets with a free face, ascending
  std::vector<int> body;    ///< per tet: the body it belonged to at the start
};

} // namespace fissura::state
