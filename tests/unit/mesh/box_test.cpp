#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>
#include <vector>

#include "fissura/geometry/tet.hpp"
#include "fissura/geometry/triangle.hpp"
#include "fissura/mesh/box.hpp"
#include "support/random_mesh.hpp"

namespace fissura::mesh {
namespace {

BoxCells box(Vec3 from, Vec3 to, std::array<int, 3> cells, int tets_per_cell = 6,
             std::string name = "concrete") {
  BoxCells b;
  b.name = std::move(name), b.from = from, b.to = to, b.cells = cells, b.tets_per_cell = tets_per_cell;
  return b;
}

double total_volume(Mesh const& m) {
  double sum = 0;
  for (int t = 0; t < static_cast<int>(m.tets.size()); ++t) sum += geometry::volume(corners(m, t));
  return sum;
}

double boundary_area(Mesh const& m) {
  double sum = 0;
  for (TetFace const f : make_adjacency(m).boundary) {
    auto const x = corners(m, f.tet);
    auto const& c = face_corners[f.face];
    sum += geometry::area({x[c[0]], x[c[1]], x[c[2]]});
  }
  return sum;
}

double group_area(Mesh const& m, std::string const& name) {
  for (auto const& g : m.face_groups) {
    if (g.name != name) continue;
    double sum = 0;
    for (auto const& t : g.triangles) sum += geometry::area({m.points[t[0]], m.points[t[1]], m.points[t[2]]});
    return sum;
  }
  return -1;
}

// Requirement: both cell types fill the box with positive tets and conform, so only the box's own sides are
// boundary.
TEST(Box, fills_and_conforms) {
  for (int per_cell : {6, 24}) {
    BoxCells const b = box({1, -1, 0}, {3, 2, 0.5}, {3, 4, 2}, per_cell);
    Mesh const m = make_boxes({&b, 1});
    EXPECT_EQ(m.tets.size(), std::size_t(per_cell) * 24);
    for (int t = 0; t < static_cast<int>(m.tets.size()); ++t)
      EXPECT_NEAR(geometry::volume(corners(m, t)), 3.0 / (24 * per_cell), 1e-14) << t;
    EXPECT_NEAR(total_volume(m), 3, 1e-13);
    EXPECT_NEAR(boundary_area(m), 2 * (2 * 3 + 2 * 0.5 + 3 * 0.5), 1e-12);
    EXPECT_NEAR(group_area(m, "concrete.y+"), 1, 1e-13);
    EXPECT_NEAR(group_area(m, "concrete.z-"), 6, 1e-12);
  }
}

// Requirement: a 10 x 2 x 2 and a 20 x 4 x 4 mesh of 6 tets per cell have the 240 and 1920 tets of the
// tension prism.
TEST(Box, tet_counts_of_the_tension_prism) {
  BoxCells const a = box({}, {1, .2, .2}, {10, 2, 2}), b = box({}, {1, .2, .2}, {20, 4, 4});
  EXPECT_EQ(make_boxes({&a, 1}).tets.size(), 240u);
  EXPECT_EQ(make_boxes({&b, 1}).tets.size(), 1920u);
}

// Requirement: grading g makes the last cell g times as long as the first, with a constant ratio between
// neighbours.
TEST(Box, grading_is_geometric) {
  BoxCells b = box({}, {1, 1, 1}, {4, 1, 1});
  b.grading = {8, 1, 1};
  Mesh const m = make_boxes({&b, 1});
  std::set<double> xs;
  for (Vec3 p : m.points) xs.insert(p.x);
  std::vector<double> const x(xs.begin(), xs.end());
  ASSERT_EQ(x.size(), 5u);
  for (int i = 1; i < 4; ++i) EXPECT_NEAR((x[i + 1] - x[i]) / (x[i] - x[i - 1]), 2, 1e-12);
  EXPECT_EQ(x[4], 1.0);
}

// Requirement: boxes whose cells match on a common side are joined there through shared points, and share
// that side as a face group of both names.
TEST(Box, touching_boxes_are_joined) {
  std::vector<BoxCells> const b{box({0, 0, 0}, {0.3, 0.1, 0.1}, {3, 2, 2}, 6, "beam"),
                                box({0.1, 0, 0.1}, {0.2, 0.1, 0.15}, {1, 2, 1}, 6, "plate")};
  Mesh const m = make_boxes(b);
  EXPECT_EQ(m.points.size(), 4u * 3 * 3 + 2 * 3 * 2 - 2 * 3);
  double const common = 0.1 * 0.1;
  EXPECT_NEAR(boundary_area(m), (2 * 0.01 + 4 * 0.03) + (2 * 0.01 + 4 * 0.005) - 2 * common, 1e-14);
  EXPECT_NEAR(group_area(m, "beam.z+"), 0.03, 1e-15);
  EXPECT_NEAR(group_area(m, "plate.z-"), common, 1e-15);
}

// Requirement: boxes of one name are one group whose sides leave out what lies between them.
TEST(Box, boxes_of_one_name_are_one_body) {
  std::vector<BoxCells> const b{box({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), box({1, 0, 0}, {3, 1, 1}, {2, 2, 2})};
  Mesh const m = make_boxes(b);
  EXPECT_EQ(m.volume_groups.size(), 1u);
  EXPECT_NEAR(group_area(m, "concrete.x+"), 1, 1e-14);
  EXPECT_NEAR(group_area(m, "concrete.x-"), 1, 1e-14);
  EXPECT_NEAR(group_area(m, "concrete.z+"), 3, 1e-14);
}

// Requirement: shared faces are sorted, their corners correspond, and the normal points from tet a to tet b.
TEST(Adjacency, corners_correspond_and_point_from_a_to_b) {
  Mesh const m = support::random_box_mesh(3);
  Adjacency const adjacency = make_adjacency(m);
  EXPECT_EQ(2 * adjacency.shared.size() + adjacency.boundary.size(), 4 * m.tets.size());
  std::pair<int, int> last{-1, -1};
  for (auto const& s : adjacency.shared) {
    EXPECT_LT(s.a.tet, s.b.tet);
    EXPECT_LT(last, std::pair(s.a.tet, s.a.face));
    last = {s.a.tet, s.a.face};
    std::array<Vec3, 3> x;
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(m.tets[s.a.tet][s.corner_a[k]], m.tets[s.b.tet][s.corner_b[k]]);
      x[k] = m.points[m.tets[s.a.tet][s.corner_a[k]]];
    }
    Vec3 const ab = geometry::centroid(corners(m, s.b.tet)) - geometry::centroid(corners(m, s.a.tet));
    EXPECT_GT(core::dot(geometry::normal(x), ab), 0);
    EXPECT_EQ(&adjacency.shared[adjacency.shared_of_tet[s.b.tet][s.b.face]], &s);
  }
}

// Requirement: random meshes are valid, keep their outline, differ by seed and repeat for the same seed.
TEST(RandomMesh, valid_and_repeatable) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Mesh const m = support::random_box_mesh(seed, {3, 2, 4}, {3, 1, 2});
    for (int t = 0; t < static_cast<int>(m.tets.size()); ++t) EXPECT_GT(geometry::volume(corners(m, t)), 0);
    EXPECT_NEAR(total_volume(m), 6, 1e-12);
    EXPECT_NEAR(boundary_area(m), 2 * (3 + 6 + 2), 1e-12);
    EXPECT_EQ(m.points, support::random_box_mesh(seed, {3, 2, 4}, {3, 1, 2}).points);
    EXPECT_NE(m.points, support::random_box_mesh(seed + 1, {3, 2, 4}, {3, 1, 2}).points);
  }
}

// Requirement: touching boxes of one body share points and faces, of different bodies none, also where their
// cells match; tets know their body after the mesh is made.
TEST(Boxes, of_different_bodies_are_not_joined) {
  auto left = box({0, 0, 0}, {1, 1, 1}, {1, 1, 1}), right = box({1, 0, 0}, {2, 1, 1}, {1, 1, 1});
  std::vector<BoxCells> boxes{left, right};
  Mesh const joined = make_boxes(boxes);
  EXPECT_EQ(joined.points.size(), 12u);
  auto const one = connected_bodies(joined, make_adjacency(joined));
  EXPECT_EQ(*std::max_element(one.begin(), one.end()), 0);
  boxes[1].body = "other";
  Mesh const apart = make_boxes(boxes);
  EXPECT_EQ(apart.points.size(), 16u);
  EXPECT_EQ(connected_bodies(apart, make_adjacency(apart)), apart.tet_body);
  EXPECT_EQ(apart.tet_body.back(), 1);
}

std::string refusal(std::vector<BoxCells> const& boxes) {
  try {
    make_boxes(boxes);
  } catch (core::InputError const& e) {
    return e.what();
  }
  return "";
}

// Requirement: boxes that make no mesh are refused by name, with the number that is wrong.
TEST(Boxes, that_make_no_mesh_are_refused) {
  BoxCells const sound = box({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  auto const expect = [&](std::vector<BoxCells> const& boxes, std::string const& reason) {
    EXPECT_NE(refusal(boxes).find(reason), std::string::npos) << refusal(boxes);
  };
  EXPECT_EQ(refusal({sound}), "");
  expect({}, "no box to mesh");
  auto wrong = sound;
  wrong.to.y = std::numeric_limits<double>::infinity();
  expect({wrong}, "box 'concrete': y is not a number");
  wrong = sound, wrong.to.z = 0;
  expect({wrong}, "box 'concrete': no extent along z: both corners are at 0 m");
  wrong = sound, wrong.cells[0] = 0;
  expect({wrong}, "0 cells along x, at least 1 is needed");
  wrong = sound, wrong.grading[1] = 0;
  expect({wrong}, "grading 0 along y is outside 1e-6 .. 1e6");
  wrong = sound, wrong.tets_per_cell = 5;
  expect({wrong}, "5 tets per cell: only 6 and 24 are known");
  wrong = sound, wrong.cells = {1000, 1000, 100};
  expect({wrong}, "the boxes ask for 6e+08 tets; at most 2.5e8 can be numbered");
  auto other = sound;
  other.from.x = 0.5, other.to.x = 2;
  expect({sound, other}, "overlap");
}

} // namespace
} // namespace fissura::mesh
