#include <gtest/gtest.h>

#include <ctime>
#include <numbers>

#include "fissura/mesh/box.hpp"
#include "fissura/mesh/check.hpp"
#include "fissura/mesh/quality.hpp"
#include "fissura/mesh/renumber.hpp"
#include "support/random_mesh.hpp"

namespace fissura::mesh {
namespace {

Quality quality_of(Mesh const& m) {
  return measure_quality(m, make_adjacency(m));
}

// Requirement: the report of a regular box mesh agrees with hand values, and a good mesh gives no warning.
TEST(Quality, regular_box) {
  BoxCells b;
  b.to = {0.6, 0.4, 0.5}, b.cells = {6, 4, 5};
  Quality const q = quality_of(make_boxes({&b, 1}));
  EXPECT_EQ(q.tets, 720);
  EXPECT_NEAR(q.volume, 0.12, 1e-14);
  EXPECT_NEAR(q.mean_volume, 1e-3 / 6, 1e-16);
  EXPECT_NEAR(q.min_volume, q.max_volume, 1e-16);
  EXPECT_NEAR(q.mean_h, 0.1 * std::cbrt(std::numbers::sqrt2), 1e-14); // (6 sqrt(2) a^3/6)^(1/3)
  EXPECT_NEAR(q.smallest_altitude, 0.1 / std::numbers::sqrt2, 1e-14);
  EXPECT_NEAR(q.smallest_angle, std::numbers::pi / 4, 1e-12);
  EXPECT_EQ(q.slivers, 0);
  EXPECT_NEAR(q.elements_over[0], 6, 1e-12);
  EXPECT_NEAR(q.elements_over[1], 4, 1e-12);
  EXPECT_NEAR(q.elements_over[2], 5, 1e-12);
  EXPECT_TRUE(quality_warnings(q).empty());
}

// Requirement: slivers are counted, and the worst tet is named by its input number and place.
TEST(Quality, names_the_sliver) {
  Mesh m;
  m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.01}, {0, 0, -1}};
  m.tets = {{0, 2, 1, 4}, {0, 1, 2, 3}};
  m.tet_group = {0, 0};
  m.volume_groups = {"rock"};
  m.input_id = {41, 42};
  ASSERT_NO_THROW(check_mesh(m));
  Quality const q = quality_of(m);
  EXPECT_EQ(q.slivers, 1);
  EXPECT_EQ(q.smallest_altitude_tet.tet, 1);
  EXPECT_NEAR(q.smallest_altitude, 0.01, 1e-12);
  auto const warnings = quality_warnings(q);
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].find("tet 42 at (0.325, 0.325, 0.0025) m"), std::string::npos) << warnings[0];
}

// Requirement: too few elements over an extent are a warning that names the axis.
TEST(Quality, warns_of_few_elements) {
  BoxCells b;
  b.to = {1, 0.2, 1}, b.cells = {5, 1, 5};
  auto const warnings = quality_warnings(quality_of(make_boxes({&b, 1})));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("about 1.0 elements over the extent along y (0.2 m)"), std::string::npos)
      << warnings[0];
}

// Requirement: faces that coincide without shared points are allowed but reported, for they carry no tension.
TEST(Quality, reports_open_interfaces) {
  BoxCells b;
  b.to = {1, 1, 1}, b.cells = {4, 4, 4};
  Mesh m = make_boxes({&b, 1});
  Mesh const lower = m;
  int const shift = static_cast<int>(m.points.size());
  for (Vec3 p : lower.points) m.points.push_back(p + Vec3{0, 0, 1});
  for (auto t : lower.tets) {
    for (int& p : t) p += shift;
    m.tets.push_back(t), m.tet_group.push_back(0), m.input_id.push_back(static_cast<int>(m.input_id.size()));
  }
  EXPECT_NO_THROW(check_mesh(m));
  Quality const q = quality_of(m);
  EXPECT_EQ(q.open_interfaces, 32);
  EXPECT_NEAR(q.open_interface_at.z, 1, 1e-12);
  auto const warnings = quality_warnings(q);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("32 pairs of boundary faces coincide"), std::string::npos) << warnings[0];
}

// Requirement: a mesh of a million tets is made, checked, renumbered and measured within seconds.
TEST(Quality, a_million_tets_take_seconds) {
  std::clock_t const start = std::clock(); // of the processor: others may want it too
  BoxCells b;
  b.to = {1, 1, 1}, b.cells = {55, 55, 55};
  Mesh m = make_boxes({&b, 1});
  check_mesh(m);
  renumber(m);
  Adjacency const adjacency = make_adjacency(m);
  Quality const q = measure_quality(m, adjacency);
  EXPECT_EQ(q.tets, 998250);
  EXPECT_EQ(adjacency.boundary.size(), 12u * 55 * 55);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 30);
}

} // namespace
} // namespace fissura::mesh
