#pragma once
// A vector for each node of the tets: x, y, z of node n are the numbers 3n, 3n + 1 and 3n + 2. A fourth, to
// align them, would add a tenth to the memory that a step moves.
#include <cstddef>

#include "fissura/core/buffer.hpp"
#include "fissura/core/vec3.hpp"

namespace fissura::core {

inline constexpr int per_node = 3;           ///< numbers of a node
inline constexpr int per_tet = 4 * per_node; ///< numbers of a tet

struct NodeField {
  Buffer<double> values;

  NodeField() = default;
  explicit NodeField(std::size_t nodes) : values(per_node * nodes) {}

  std::size_t nodes() const { return values.size() / per_node; }
  Vec3 at(std::size_t node) const {
    double const* const p = of_node(node);
    return {p[0], p[1], p[2]};
  }
  double operator()(std::size_t node, int axis) const { return of_node(node)[axis]; }
  double& operator()(std::size_t node, int axis) { return of_node(node)[axis]; }

  double* data() { return values.data(); }
  double const* data() const { return values.data(); }
  double* of_node(std::size_t node) { return data() + per_node * node; }
  double const* of_node(std::size_t node) const { return data() + per_node * node; }
  double* of_tet(std::size_t tet) { return data() + per_tet * tet; }
  double const* of_tet(std::size_t tet) const { return data() + per_tet * tet; }
};

} // namespace fissura::core
