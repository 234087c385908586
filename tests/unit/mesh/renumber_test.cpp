#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "fissura/geometry/tet.hpp"
#include "fissura/geometry/triangle.hpp"
#include "fissura/mesh/renumber.hpp"
#include "support/random_mesh.hpp"

namespace fissura::mesh {
namespace {

// Requirement: the Hilbert index is one-to-one on a grid and consecutive indices are neighbouring cells.
TEST(Hilbert, visits_every_cell_through_neighbours) {
  constexpr int bits = 4, n = 1 << bits;
  std::vector<std::array<int, 3>> cell_of(n * n * n, {-1, -1, -1});
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z)
        cell_of.at(hilbert_index({unsigned(x), unsigned(y), unsigned(z)}, bits)) = {x, y, z};
  for (std::size_t i = 1; i < cell_of.size(); ++i) {
    int distance = 0;
    for (int k = 0; k < 3; ++k) distance += std::abs(cell_of[i][k] - cell_of[i - 1][k]);
    ASSERT_EQ(distance, 1) << i;
  }
}

// Requirement: renumbering keeps every tet (by its input number) where it was, with its group, and the
// groups' areas.
TEST(Renumber, keeps_the_geometry) {
  Mesh const before = support::random_box_mesh(5, {4, 3, 2}, {4, 3, 2});
  Mesh after = before;
  after.points.push_back({7, 7, 7}); // used by nothing
  renumber(after);
  ASSERT_EQ(after.tets.size(), before.tets.size());
  EXPECT_EQ(after.points.size(), before.points.size());
  std::vector<int> ids = after.input_id;
  std::sort(ids.begin(), ids.end());
  for (int t = 0; t < static_cast<int>(ids.size()); ++t) {
    EXPECT_EQ(ids[t], t);
    EXPECT_EQ(corners(after, t), corners(before, after.input_id[t]));
  }
  for (std::size_t g = 0; g < before.face_groups.size(); ++g)
    for (std::size_t i = 0; i < before.face_groups[g].triangles.size(); ++i)
      for (int k = 0; k < 3; ++k)
        EXPECT_EQ(after.points[after.face_groups[g].triangles[i][k]],
                  before.points[before.face_groups[g].triangles[i][k]]);
}

// Requirement: points are numbered in the order in which the tets first use them.
TEST(Renumber, points_by_first_use) {
  Mesh m = support::random_box_mesh(1);
  renumber(m);
  int next = 0;
  for (auto const& t : m.tets)
    for (int p : t) {
      EXPECT_LE(p, next);
      next = std::max(next, p + 1);
    }
}

// Requirement: in the new order consecutive tets are near each other, and a second renumbering changes
// nothing.
TEST(Renumber, is_local_and_stable) {
  BoxCells b;
  b.to = {1, 1, 1}, b.cells = {16, 16, 16};
  Mesh m = make_boxes({&b, 1});
  renumber(m);
  double farthest = 0;
  for (int t = 1; t < static_cast<int>(m.tets.size()); ++t)
    farthest = std::max(
        farthest, core::norm(geometry::centroid(corners(m, t)) - geometry::centroid(corners(m, t - 1))));
  EXPECT_LT(farthest, 2.0 / 16);
  Mesh again = m;
  renumber(again);
  EXPECT_EQ(again.tets, m.tets);
  EXPECT_EQ(again.points, m.points);
  EXPECT_EQ(again.input_id, m.input_id);
}

// Requirement: points that nothing uses are dropped; points of a curve outside the tets stay.
TEST(Renumber, drops_unused_points_only) {
  Mesh m = support::random_box_mesh(2);
  auto const n = static_cast<int>(m.points.size());
  m.points.insert(m.points.begin(), {9, 9, 9});
  for (auto& t : m.tets)
    for (int& p : t) ++p;
  m.face_groups.clear();
  m.points.push_back({5, 0, 0});
  m.points.push_back({6, 0, 0});
  m.line_groups.push_back({"bar", {{n + 1, n + 2}}});
  drop_unused_points(m);
  ASSERT_EQ(static_cast<int>(m.points.size()), n + 2);
  EXPECT_EQ(m.points[m.line_groups[0].segments[0][0]], (Vec3{5, 0, 0}));
  EXPECT_EQ(m.points[m.line_groups[0].segments[0][1]], (Vec3{6, 0, 0}));
  EXPECT_EQ(m.points, [&] {
    Mesh r = support::random_box_mesh(2);
    r.points.push_back({5, 0, 0});
    r.points.push_back({6, 0, 0});
    return r.points;
  }());
}

} // namespace
} // namespace fissura::mesh
