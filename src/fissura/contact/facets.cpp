#include "fissura/contact/facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "fissura/geometry/triangle.hpp"
#include "fissura/mesh/faces.hpp"

namespace fissura::contact {

namespace {

constexpr double sharpest = std::numbers::pi / 3; ///< beyond it an edge is an edge of the drawing
constexpr double flattest = 1e-6;

double sagitta(mesh::Mesh const& m, mesh::TetFace a, mesh::TetFace b, double edge) {
  auto const ta = mesh::face_triangle(m, a), tb = mesh::face_triangle(m, b);
  double const cosine = dot(geometry::normal(ta), geometry::normal(tb));
  double const theta = std::acos(std::clamp(cosine, -1.0, 1.0));
  if (theta > sharpest || theta < flattest) return 0;
  double const width = std::max(geometry::area(ta), geometry::area(tb)) * 2 / edge;
  return 0.5 * width * std::tan(theta / 4);
}

} // namespace

double largest_sagitta(mesh::Mesh const& m, mesh::Adjacency const& adjacency,
                       std::vector<char> const& chosen) {
  std::map<std::array<int, 2>, std::vector<mesh::TetFace>> at_edge;
  for (auto const f : adjacency.boundary) {
    auto const p = mesh::face_points(m, f);
    for (std::size_t k = 0; k < 3; ++k) {
      int const a = p[k], b = p[(k + 1) % 3];
      at_edge[{std::min(a, b), std::max(a, b)}].push_back(f);
    }
  }
  double largest = 0;
  for (auto const& [edge, faces] : at_edge) {
    if (faces.size() != 2) continue;
    if (!chosen[static_cast<std::size_t>(faces[0].tet)] && !chosen[static_cast<std::size_t>(faces[1].tet)])
      continue;
    double const length =
        norm(m.points[static_cast<std::size_t>(edge[1])] - m.points[static_cast<std::size_t>(edge[0])]);
    if (length > 0) largest = std::max(largest, sagitta(m, faces[0], faces[1], length));
  }
  return largest;
}

} // namespace fissura::contact
