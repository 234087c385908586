#include "fissura/mesh/faces.hpp"

#include <algorithm>
#include <numeric>

namespace fissura::mesh {

FaceFinder::FaceFinder(Mesh const& mesh_)
    : mesh(mesh_), begin(mesh_.points.size() + 2, 0), tets(4 * mesh_.tets.size()) {
  for (auto const& t : mesh.tets)
    for (int p : t) ++begin[p + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t)
    for (int p : mesh.tets[t]) tets[begin[p + 1]++] = t;
}

std::vector<TetFace> FaceFinder::find(std::array<int, 3> const& triangle) const {
  std::vector<TetFace> sides;
  for (int i = begin[triangle[0]]; i < begin[triangle[0] + 1]; ++i) {
    auto const& t = mesh.tets[tets[i]];
    int opposite = 6; // sum of the corner numbers less those of the triangle's points
    bool all = true;
    for (int p : triangle) {
      auto const corner = std::find(t.begin(), t.end(), p) - t.begin();
      all = all && corner < 4;
      opposite -= static_cast<int>(corner);
    }
    if (all) sides.push_back({tets[i], opposite});
  }
  return sides;
}

std::vector<char> points_of_tets(Mesh const& mesh) {
  std::vector<char> used(mesh.points.size(), 0);
  for (auto const& t : mesh.tets)
    for (int p : t) used[p] = 1;
  return used;
}

} // namespace fissura::mesh
