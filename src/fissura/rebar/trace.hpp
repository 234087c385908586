#pragma once
// Follows the axis of a bar through the mesh: which tets it passes, where, and through which faces.
#include <string>
#include <vector>

#include "fissura/core/error.hpp"
#include "fissura/core/vec3.hpp"
#include "fissura/mesh/mesh.hpp"
#include "fissura/rebar/polyline.hpp"
#include "fissura/rebar/tet_grid.hpp"

namespace fissura::rebar {

/// The bar inside one tet, between two arc lengths [m].
struct Piece {
  int tet = -1;
  double begin = 0, end = 0;
  double length() const { return end - begin; }
};

/// A face that lies between two pieces.
struct Crossed {
  int shared_face = -1;
  Vec3 point;     ///< where the bar passes [m]
  Vec3 direction; ///< unit vector along the bar there
};

/// A chain of pieces; the first begins at 0, the last ends at the bar's length, each begins where the one
/// before ends. Consecutive pieces are in different tets. crossed[i]: the faces between piece i - 1 and piece
/// i; crossed[0] those between the last piece and the first of a closed bar (of no meaning otherwise).
struct Chain {
  std::vector<Piece> pieces;
  std::vector<std::vector<Crossed>> crossed;
};

/// What a search line needs to know.
struct TraceContext {
  mesh::Mesh const& mesh;
  mesh::Adjacency const& adjacency;
  TetGrid const& grid;
};

/// Local cell size [m]: edge of the regular tet with the volume of tet `tet`.
double cell_size(mesh::Mesh const& mesh, int tet);

/// All tets that the bar passes. The search line is shifted normal to the bar by 1e-4 and 0.618e-4 of the
/// smallest cell near it, so that a bar along edges or faces of the mesh has a unique tet everywhere; of the
/// eight ways to shift it the first that stays inside the concrete is taken, so a bar may lie on the surface.
/// Where none does, a hundredth of the shift is tried.
/// Throws core::InputError at `place` where the bar is outside the concrete, with the coordinates where it
/// leaves.
Chain trace(TraceContext const& context, Polyline const& line, std::string const& name,
            core::Place const& place);

/// The faces on a shortest way from tet a to tet b through tets that hold p (within 1 % of their size); empty
/// where a = b. Throws core::InputError where there is no such way: the two tets belong to bodies that only
/// touch.
std::vector<int> faces_between(TraceContext const& context, int a, int b, Vec3 p, std::string const& name,
                               core::Place const& place);

} // namespace fissura::rebar
