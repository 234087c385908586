#pragma once
// Built-in meshes: boxes of regular or graded cells, each cell cut into 6 or 24 tets.
#include <array>
#include <span>
#include <string>

#include "fissura/core/error.hpp"
#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// One box of cells.
struct BoxCells {
  std::string name = "concrete"; ///< volume group of its tets
  Vec3 from, to;                 ///< opposite corners [m]
  std::array<int, 3> cells{1, 1, 1};
  int tets_per_cell = 6; ///< 6 (Kuhn, all diagonals alike) or 24 (cell centre and face centres)
  std::array<double, 3> grading{1, 1, 1}; ///< last cell length / first cell length along each axis
  core::Place place;                      ///< named in errors
  std::string body;                       ///< boxes of different bodies are not joined
};

/// One mesh of all boxes. Points of different boxes closer than 1e-9 of the largest extent are one point, so
/// boxes of one body whose cells match on a common side are joined. Boxes of one name are one volume group.
/// The sides of the boxes of a name are the face groups "<name>.x-", "<name>.x+", "<name>.y-", ...; a side
/// between two boxes of the same name belongs to none, a side between two names to both. Tets are numbered
/// box by box, cell by cell (x fastest). Throws core::InputError for impossible numbers and for boxes that
/// overlap.
Mesh make_boxes(std::span<BoxCells const> boxes);

} // namespace fissura::mesh
