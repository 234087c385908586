// Which tets share a face: all faces are put into bins by their lowest point, and each small bin is sorted.
#include <algorithm>
#include <numeric>
#include <span>

#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

namespace {

struct Face {
  int middle, highest; ///< its two higher points; the lowest is that of the bin
  int side;            ///< 4 tet + face
  bool same_points(Face const& b) const { return middle == b.middle && highest == b.highest; }
  bool operator<(Face const& b) const {
    return middle != b.middle     ? middle < b.middle
           : highest != b.highest ? highest < b.highest
                                  : side < b.side;
  }
};

std::array<int, 3> sorted_face(Mesh const& mesh, int side) {
  auto const& tet = mesh.tets[side / 4];
  auto const& c = face_corners[side % 4];
  std::array<int, 3> p{tet[c[0]], tet[c[1]], tet[c[2]]};
  std::sort(p.begin(), p.end());
  return p;
}

[[noreturn]] void refuse(Mesh const& mesh, std::span<Face const> faces) {
  std::string tets;
  for (Face const& f : faces) {
    int const t = f.side / 4;
    tets += fmt::format("{}{}", tets.empty() ? "" : ", ", mesh.input_id.empty() ? t : mesh.input_id[t]);
  }
  auto const p = sorted_face(mesh, faces[0].side);
  Vec3 const c = (mesh.points[p[0]] + mesh.points[p[1]] + mesh.points[p[2]]) / 3;
  throw core::InputError(
      {}, fmt::format("{} tets share one face at ({:g}, {:g}, {:g}) m: tets {}; a face joins two "
                      "tets at most",
                      faces.size(), c.x, c.y, c.z, tets));
}

/// For each side 4 tet + face the other side of the same face, or -1.
std::vector<int> find_mates(Mesh const& mesh) {
  int const sides = 4 * static_cast<int>(mesh.tets.size());
  std::vector<int> begin(mesh.points.size() + 2, 0);
  for (int s = 0; s < sides; ++s) ++begin[sorted_face(mesh, s)[0] + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Face> faces(sides);
  for (int s = 0; s < sides; ++s) {
    auto const p = sorted_face(mesh, s);
    faces[begin[p[0] + 1]++] = {p[1], p[2], s};
  }
  std::vector<int> mate(sides, -1);
  for (std::size_t bin = 0; bin + 1 < begin.size(); ++bin) {
    auto const first = faces.begin() + begin[bin], last = faces.begin() + begin[bin + 1];
    std::sort(first, last);
    for (auto f = first; f != last;) {
      auto const end = std::find_if(f, last, [&](Face const& g) { return !f->same_points(g); });
      if (end - f > 2) refuse(mesh, {f, end});
      if (end - f == 2) mate[f[0].side] = f[1].side, mate[f[1].side] = f[0].side;
      f = end;
    }
  }
  return mate;
}

SharedFace shared_face(Mesh const& mesh, int side_a, int side_b) {
  SharedFace s;
  s.a = {side_a / 4, side_a % 4};
  s.b = {side_b / 4, side_b % 4};
  s.corner_a = face_corners[s.a.face];
  auto const& ta = mesh.tets[s.a.tet];
  auto const& tb = mesh.tets[s.b.tet];
  for (int k = 0; k < 3; ++k)
    s.corner_b[k] =
        static_cast<std::uint8_t>(std::find(tb.begin(), tb.end(), ta[s.corner_a[k]]) - tb.begin());
  return s;
}

} // namespace

Adjacency make_adjacency(Mesh const& mesh) {
  auto const mate = find_mates(mesh);
  Adjacency adjacency;
  adjacency.shared.reserve(mate.size() / 2);
  adjacency.shared_of_tet.assign(mesh.tets.size(), {-1, -1, -1, -1});
  for (int side = 0; side < static_cast<int>(mate.size()); ++side) {
    if (mate[side] < 0) adjacency.boundary.push_back({side / 4, side % 4});
    if (mate[side] < side) continue;
    int const number = static_cast<int>(adjacency.shared.size());
    adjacency.shared_of_tet[side / 4][side % 4] = number;
    adjacency.shared_of_tet[mate[side] / 4][mate[side] % 4] = number;
    adjacency.shared.push_back(shared_face(mesh, side, mate[side]));
  }
  return adjacency;
}

std::vector<int> connected_bodies(Mesh const& mesh, Adjacency const& adjacency) {
  std::vector<int> body(mesh.tets.size(), -1), open;
  int count = 0;
  for (int first = 0; first < static_cast<int>(body.size()); ++first) {
    if (body[first] >= 0) continue;
    body[first] = count;
    open.push_back(first);
    while (!open.empty()) {
      int const tet = open.back();
      open.pop_back();
      for (int const f : adjacency.shared_of_tet[tet]) {
        if (f < 0) continue;
        auto const& face = adjacency.shared[f];
        int const other = face.a.tet == tet ? face.b.tet : face.a.tet;
        if (body[other] >= 0) continue;
        body[other] = count;
        open.push_back(other);
      }
    }
    ++count;
  }
  return body;
}

} // namespace fissura::mesh
