#pragma once
// Where the corners of tets are. Nodal arrays hold x, y, z, 0 of node 4 tet + corner from entry 4 (4 tet +
// corner).
#include "fissura/core/vec3.hpp"

namespace fissura::rebar {

/// Reference positions X and displacements u of all nodes [m].
struct Nodes {
  double const* position;
  double const* u;

  static Vec3 read(double const* a, int node) { return {a[4 * node], a[4 * node + 1], a[4 * node + 2]}; }
  Vec3 displacement(int tet, int corner) const { return read(u, 4 * tet + corner); }
  Vec3 current(int tet, int corner) const {
    return read(position, 4 * tet + corner) + read(u, 4 * tet + corner);
  }
};

} // namespace fissura::rebar
