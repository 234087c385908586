#pragma once
// Where the corners of tets are.
#include "fissura/core/node_field.hpp"
#include "fissura/model/blocks.hpp"

namespace fissura::rebar {

/// Reference positions X and displacements u of all nodes [m].
struct Nodes {
  core::NodeField const& position;
  core::NodeField const& u;

  Vec3 displacement(int tet, int corner) const { return u.at(model::node_of(tet, corner)); }
  Vec3 current(int tet, int corner) const {
    return position.at(model::node_of(tet, corner)) + displacement(tet, corner);
  }
};

} // namespace fissura::rebar
