#pragma once
// Random tetrahedral meshes for tests: a box of Kuhn cells whose points are moved at random.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/box.hpp"
#include "fissura/mesh/mesh.hpp"
#include "support/random.hpp"

namespace fissura::support {

/// A box from the origin to `size` [m] in cells of 6 tets, its points moved by up to `amount` cell lengths
/// along each axis; points on a side stay in it, corners stay. Moves that would leave a tet with less than a
/// fifth of its volume are halved, so the mesh is always valid. Groups as in make_boxes (name "concrete").
inline mesh::Mesh random_box_mesh(std::uint64_t seed, std::array<int, 3> cells = {3, 3, 3},
                                  Vec3 size = {1, 1, 1}, double amount = 0.25) {
  mesh::BoxCells box;
  box.to = size;
  box.cells = cells;
  mesh::Mesh m = mesh::make_boxes({&box, 1});
  std::vector<Vec3> const start = m.points;
  Random random(seed);
  std::vector<Vec3> move(start.size());
  for (std::size_t i = 0; i < start.size(); ++i) {
    move[i] = random.vector(-amount, amount);
    for (int k = 0; k < 3; ++k) {
      bool const on_side = start[i][k] <= 1e-9 * size[k] || start[i][k] >= (1 - 1e-9) * size[k];
      move[i][k] *= on_side ? 0 : size[k] / cells[k];
    }
  }
  double const least = 0.2 * size.x * size.y * size.z / (6.0 * cells[0] * cells[1] * cells[2]);
  for (bool valid = false; !valid;) {
    for (std::size_t i = 0; i < start.size(); ++i) m.points[i] = start[i] + move[i];
    valid = true;
    for (int t = 0; t < static_cast<int>(m.tets.size()); ++t) {
      if (geometry::volume(mesh::corners(m, t)) >= least) continue;
      valid = false;
      for (int p : m.tets[t]) move[p] *= 0.5;
    }
  }
  return m;
}

} // namespace fissura::support
