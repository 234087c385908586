#include "fissura/mesh/merge.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

namespace fissura::mesh {

double largest_extent(std::span<Vec3 const> points) {
  if (points.empty()) return 0;
  Vec3 low = points[0], high = points[0];
  for (Vec3 const& p : points)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

namespace {

/// Points in cubic cells much larger than the tolerance: flat hash of the cell, chains through `next`.
class PointCells {
 public:
  PointCells(std::span<Vec3 const> points_, double cell_)
      : points(points_), cell(cell_), heads(std::bit_ceil(2 * points_.size() + 2), -1),
        next(points_.size(), -1) {}

  void insert(int i) {
    auto& head = heads[slot(index(points[i], {}))];
    next[i] = head, head = i;
  }

  /// Smallest inserted index within the tolerance of p, or -1.
  int find(Vec3 p, double tolerance) const {
    int best = -1;
    auto const low = index(p, Vec3{-tolerance, -tolerance, -tolerance});
    auto const high = index(p, Vec3{tolerance, tolerance, tolerance});
    for (auto x = low[0]; x <= high[0]; ++x)
      for (auto y = low[1]; y <= high[1]; ++y)
        for (auto z = low[2]; z <= high[2]; ++z)
          for (int j = heads[slot({x, y, z})]; j >= 0; j = next[j])
            if (core::norm(points[j] - p) <= tolerance && (best < 0 || j < best)) best = j;
    return best;
  }

 private:
  using Index = std::array<std::int64_t, 3>;
  Index index(Vec3 p, Vec3 shift) const {
    Index i{};
    for (int k = 0; k < 3; ++k) i[k] = static_cast<std::int64_t>(std::floor((p[k] + shift[k]) / cell));
    return i;
  }
  std::size_t slot(Index i) const {
    std::uint64_t h = 0;
    for (auto k : i) {
      h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15ULL;
      h ^= h >> 29;
    }
    return h & (heads.size() - 1);
  }

  std::span<Vec3 const> points;
  double cell;
  std::vector<int> heads, next;
};

} // namespace

std::vector<int> find_coincident(std::span<Vec3 const> points, double tolerance) {
  // The cells also have a floor that keeps their numbers within 64 bits far away from the origin.
  double far = 0;
  for (Vec3 const& p : points) far = std::max({far, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  double const cell = std::max({1e3 * tolerance, 1e-15 * far, std::numeric_limits<double>::min()});
  PointCells cells(points, cell);
  std::vector<int> first(points.size());
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    int const j = cells.find(points[i], tolerance);
    first[i] = j < 0 ? i : j;
    if (j < 0) cells.insert(i);
  }
  return first;
}

} // namespace fissura::mesh
