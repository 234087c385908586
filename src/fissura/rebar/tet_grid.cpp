#include "fissura/rebar/tet_grid.hpp"

#include <algorithm>
#include <cmath>

namespace fissura::rebar {

namespace {

struct Box {
  Vec3 low, high;
};

Vec3 min(Vec3 a, Vec3 b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 max(Vec3 a, Vec3 b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

Box box_of(std::array<Vec3, 4> const& x) {
  return {min(min(x[0], x[1]), min(x[2], x[3])), max(max(x[0], x[1]), max(x[2], x[3]))};
}

} // namespace

std::array<int, 3> TetGrid::cell_of(Vec3 p) const {
  std::array<int, 3> c;
  for (int i = 0; i < 3; ++i)
    c[i] = static_cast<int>(std::clamp(std::floor((p[i] - low_[i]) / cell_), 0.0, count_[i] - 1.0));
  return c;
}

template <class Visit> void TetGrid::for_cells(Vec3 low, Vec3 high, Visit const& visit) const {
  auto const a = cell_of(low), b = cell_of(high);
  for (int k = a[2]; k <= b[2]; ++k)
    for (int j = a[1]; j <= b[1]; ++j)
      for (int i = a[0]; i <= b[0]; ++i) visit((k * count_[1] + j) * count_[0] + i);
}

TetGrid::TetGrid(mesh::Mesh const& mesh) {
  int const tets = static_cast<int>(mesh.tets.size());
  std::vector<Box> box(tets);
  double extent = 0;
  for (int t = 0; t < tets; ++t) {
    box[t] = box_of(corners(mesh, t));
    low_ = t == 0 ? box[t].low : min(low_, box[t].low);
    high_ = t == 0 ? box[t].high : max(high_, box[t].high);
    Vec3 const e = box[t].high - box[t].low;
    extent += (e.x + e.y + e.z) / 3;
  }
  Vec3 const size = high_ - low_;
  // About one tet box per cell, and never many more cells than tets, however uneven the mesh.
  cell_ = std::max(tets > 0 ? extent / tets : 1.0, std::cbrt(size.x * size.y * size.z / (4.0 * tets + 64)));
  for (int i = 0; i < 3; ++i) count_[i] = 1 + static_cast<int>(size[i] / cell_);
  start_.assign(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2] + 1, 0);
  for (auto const& b : box) for_cells(b.low, b.high, [&](int c) { ++start_[c + 1]; });
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  tet_.resize(start_.back());
  auto next = start_;
  for (int t = 0; t < tets; ++t) for_cells(box[t].low, box[t].high, [&](int c) { tet_[next[c]++] = t; });
}

std::vector<int> TetGrid::near_segment(Vec3 a, Vec3 b, double margin) const {
  std::vector<int> found;
  int const steps = 1 + static_cast<int>(norm(b - a) / cell_);
  Vec3 const m{margin, margin, margin};
  for (int s = 0; s < steps; ++s) {
    Vec3 const p = a + (static_cast<double>(s) / steps) * (b - a), q = a + ((s + 1.0) / steps) * (b - a);
    for_cells(min(p, q) - m, max(p, q) + m, [&](int c) {
      found.insert(found.end(), tet_.begin() + start_[c], tet_.begin() + start_[c + 1]);
    });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

} // namespace fissura::rebar
