#pragma once
// Finds the tets near a line: a uniform grid over the boxes of the tets.
#include <array>
#include <vector>

#include "fissura/core/vec3.hpp"
#include "fissura/mesh/mesh.hpp"

namespace fissura::rebar {

class TetGrid {
 public:
  explicit TetGrid(mesh::Mesh const& mesh);

  /// All tets whose box comes within `margin` [m] of the segment a b, and perhaps a few more, ascending.
  std::vector<int> near_segment(Vec3 a, Vec3 b, double margin) const;

 private:
  std::array<int, 3> cell_of(Vec3 p) const;
  template <class Visit> void for_cells(Vec3 low, Vec3 high, Visit const& visit) const;

  Vec3 low_, high_;
  double cell_ = 1;
  std::array<int, 3> count_{1, 1, 1};
  std::vector<int> start_, tet_; // cell c holds tet_[start_[c]] .. tet_[start_[c+1]-1]
};

} // namespace fissura::rebar
