// Candidates come from a grid of cells: each boundary face is listed in the cells its bounding box touches,
// and two faces are compared in the one cell that holds the lower corner of their boxes' common part.
#include "fissura/mesh/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fissura/mesh/faces.hpp"

namespace fissura::mesh {

namespace {

struct Flat {
  geometry::Triangle corner;
  Vec3 normal, low, high;
  double area = 0, longest = 0;
};

Flat make_flat(geometry::Triangle const& t) {
  Flat f{t, geometry::normal(t), t[0], t[0], geometry::area(t), geometry::longest_edge(t)};
  for (Vec3 const p : t)
    for (int k = 0; k < 3; ++k) f.low[k] = std::min(f.low[k], p[k]), f.high[k] = std::max(f.high[k], p[k]);
  for (int k = 0; k < 3; ++k) f.low[k] -= 1e-4 * f.longest, f.high[k] += 1e-4 * f.longest;
  return f;
}

using Cell = std::array<std::int32_t, 3>;

struct Grid {
  Vec3 origin;
  double size = 1;
  Cell cell(Vec3 p) const {
    Cell c{};
    for (int k = 0; k < 3; ++k) {
      double const at = std::floor((p[k] - origin[k]) / size);
      c[k] =
          std::abs(at) < 1e9 ? static_cast<std::int32_t>(at) : 0; // a mesh of absurd size: any cell will do
    }
    return c;
  }
  double cells_of(Flat const& f) const {
    Cell const a = cell(f.low), b = cell(f.high);
    return (1.0 + b[0] - a[0]) * (1.0 + b[1] - a[1]) * (1.0 + b[2] - a[2]);
  }
};

/// Cells as large as a mean face, or larger where a few huge faces would fill too many of them.
Grid make_grid(std::vector<Flat> const& faces) {
  Grid grid;
  grid.origin = faces[0].low;
  Vec3 far = faces[0].high;
  double sum = 0;
  for (Flat const& f : faces) {
    for (int k = 0; k < 3; ++k)
      grid.origin[k] = std::min(grid.origin[k], f.low[k]), far[k] = std::max(far[k], f.high[k]);
    sum += f.longest;
  }
  Vec3 const extent = far - grid.origin;
  grid.size =
      std::max(sum / static_cast<double>(faces.size()), 1e-9 * std::max({extent.x, extent.y, extent.z}));
  for (;; grid.size *= 2) {
    double entries = 0;
    for (Flat const& f : faces) entries += grid.cells_of(f);
    if (entries <= 32.0 * static_cast<double>(faces.size())) return grid;
  }
}

struct Entry {
  Cell cell;
  int face;
  bool operator<(Entry const& e) const { return cell != e.cell ? cell < e.cell : face < e.face; }
};

std::vector<Entry> sort_into_cells(std::vector<Flat> const& faces, Grid const& grid) {
  std::vector<Entry> entries;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    Cell const a = grid.cell(faces[f].low), b = grid.cell(faces[f].high);
    for (auto x = a[0]; x <= b[0]; ++x)
      for (auto y = a[1]; y <= b[1]; ++y)
        for (auto z = a[2]; z <= b[2]; ++z) entries.push_back({{x, y, z}, f});
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

bool boxes_meet_in(Flat const& a, Flat const& b, Grid const& grid, Cell const& cell) {
  Vec3 low;
  for (int k = 0; k < 3; ++k) {
    low[k] = std::max(a.low[k], b.low[k]);
    if (low[k] > std::min(a.high[k], b.high[k])) return false;
  }
  return grid.cell(low) == cell;
}

bool in_one_plane(Flat const& a, Flat const& b, double tolerance) {
  if (std::abs(core::dot(a.normal, b.normal)) < 0.99) return false;
  for (Vec3 const p : b.corner)
    if (std::abs(core::dot(p - a.corner[0], a.normal)) > tolerance) return false;
  return true;
}

bool same_corners(Flat const& a, Flat const& b, double tolerance) {
  return std::all_of(a.corner.begin(), a.corner.end(), [&](Vec3 p) {
    return std::any_of(b.corner.begin(), b.corner.end(),
                       [&](Vec3 q) { return core::norm(p - q) <= tolerance; });
  });
}

/// Common area of two faces; 0 where it is below a hundredth of the smaller one.
double common_area(Flat const& large, Flat const& small) {
  if (!in_one_plane(large, small, 1e-4 * small.longest)) return 0;
  double const area = geometry::overlap_area(large.corner, small.corner);
  return area > 0.01 * small.area ? area : 0;
}

} // namespace

std::vector<FaceOverlap> find_overlaps(Mesh const& mesh, Adjacency const& adjacency) {
  std::vector<Flat> faces;
  for (TetFace const f : adjacency.boundary) faces.push_back(make_flat(face_triangle(mesh, f)));
  if (faces.empty()) return {};
  Grid const grid = make_grid(faces);
  auto const entries = sort_into_cells(faces, grid);
  std::vector<std::pair<std::array<int, 2>, FaceOverlap>> found;
  for (auto i = entries.begin(); i != entries.end(); ++i)
    for (auto j = i + 1; j != entries.end() && j->cell == i->cell; ++j) {
      Flat const &a = faces[i->face], &b = faces[j->face];
      if (!boxes_meet_in(a, b, grid, i->cell)) continue;
      Flat const &large = a.area < b.area ? b : a, &small = a.area < b.area ? a : b;
      double const area = common_area(large, small);
      if (!(area > 0)) continue;
      bool const opposite = core::dot(a.normal, b.normal) < 0;
      found.push_back(
          {{i->face, j->face},
           {adjacency.boundary[i->face], adjacency.boundary[j->face], area, geometry::centroid(small.corner),
            opposite && same_corners(a, b, 1e-4 * small.longest)}});
    }
  std::sort(found.begin(), found.end(), [](auto const& a, auto const& b) { return a.first < b.first; });
  std::vector<FaceOverlap> overlaps;
  for (auto const& f : found) overlaps.push_back(f.second);
  return overlaps;
}

} // namespace fissura::mesh
