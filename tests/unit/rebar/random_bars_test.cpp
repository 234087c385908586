// Bars at random through meshes at random: whatever way a bar takes, all of it is there. Some dozen here,
// 10^4 in `make properties` (FISSURA_RANDOM).
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "rebar_case.hpp"

namespace fissura::test {
namespace {

using support::Random;

struct Trial {
  Vec3 size;
  mesh::Mesh mesh;
  model::BarSpec bar;
  double length = 0; ///< of all copies [m]
};

/// A point that lies in the body of size `size`, at times on its surface.
Vec3 point_within(Random& r, Vec3 size) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = size[k] * (r.chance(0.1) ? r.below(2) : r.uniform(0, 1));
  return p;
}

/// Straight or bent, across or along the edges of the mesh, on the surface, in copies, closed.
Trial any_trial(int seed) {
  Random r(seed);
  Trial t;
  t.size = {r.log_uniform(0.1, 10), r.log_uniform(0.1, 2), r.log_uniform(0.1, 2)};
  std::array<int, 3> const cells{1 + r.below(8), 1 + r.below(5), 1 + r.below(5)};
  bool const regular = r.chance(0.3);
  t.mesh = regular
               ? kuhn_box(cells, t.size)
               : support::random_box_mesh(static_cast<std::uint64_t>(seed), cells, t.size, r.uniform(0, 0.3));
  std::vector<Vec3> points(static_cast<std::size_t>(2 + r.below(4)));
  for (auto& p : points) p = point_within(r, t.size);
  if (regular && r.chance(0.5)) { // along edges or in faces of the mesh
    points = {points[0], points[0]};
    points[0].x = 0, points[1].x = t.size.x;
    double const y = t.size.y * r.below(cells[1] + 1) / cells[1];
    for (auto& p : points) p.y = y;
  }
  t.bar = bar_along(points, r.log_uniform(0.006, 0.04));
  t.bar.closed = points.size() > 2 && r.chance(0.3);
  for (std::size_t i = 1; i < points.size(); ++i) t.length += norm(points[i] - points[i - 1]);
  if (t.bar.closed) t.length += norm(points.front() - points.back());
  if (!t.bar.closed && r.chance(0.3)) {
    double highest = 0;
    for (auto const& p : points) highest = std::max(highest, p.z);
    t.bar.count = 1 + r.below(4);
    t.bar.spacing = {0, 0, (t.size.z - highest) / t.bar.count * r.uniform(0.1, 1)};
    t.length *= t.bar.count;
  }
  return t;
}

// Requirement: the pieces of a bar sum to its length, its steel has the mass rho A l, both to 1e-12; no piece
// has a weight that does not belong to its tet, and each is joined to the next without a gap.
TEST(RandomBars, keep_length_and_mass) {
  int pieces = 0;
  for (int seed = 0, n = support::random_count(60); seed < n; ++seed) {
    auto const t = any_trial(seed);
    Embedded const e = embed(t.mesh, {t.bar});
    double length = 0;
    auto const& elements = e.bars().elements;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      auto const& x = elements[i];
      length += x.length;
      ASSERT_GT(x.length, 0) << seed;
      ASSERT_NEAR(norm(e.end_of(x) - e.start_of(x)), x.length, 1e-12 * t.length) << seed;
      bool const goes_on = i > 0 && elements[i - 1].copy == x.copy;
      if (goes_on) {
        ASSERT_LT(norm(e.end_of(elements[i - 1]) - e.start_of(x)), 1e-12 * norm(t.size)) << seed;
      }
    }
    double const area = std::numbers::pi / 4 * t.bar.diameter * t.bar.diameter, mass = 7850 * area * t.length;
    ASSERT_NEAR(length, t.length, 1e-12 * t.length) << seed;
    ASSERT_NEAR(e.embedding.report.length(), t.length, 1e-12 * t.length) << seed;
    std::vector<double> corner_mass(4 * e.mesh.tets.size(), 0);
    rebar::add_steel_mass(e.bars(), corner_mass);
    double sum = 0;
    for (double const m : corner_mass) sum += m;
    ASSERT_NEAR(sum, mass, 1e-12 * mass) << seed;
    pieces += static_cast<int>(elements.size());
  }
  RecordProperty("pieces", pieces);
}

// Requirement: a bar that leaves the body, by much or by little, is refused and never cut.
TEST(RandomBars, outside_are_refused) {
  for (int seed = 0, n = support::random_count(60); seed < n; ++seed) {
    Random r(1000 + static_cast<std::uint64_t>(seed));
    auto t = any_trial(seed);
    t.bar.count = 1;
    auto& p = t.bar.points[static_cast<std::size_t>(r.below(static_cast<int>(t.bar.points.size())))];
    int const axis = r.below(3);
    double const by = t.size[axis] * r.log_uniform(0.01, 3);
    p[axis] = r.chance(0.5) ? -by : t.size[axis] + by;
    EXPECT_THROW(embed(t.mesh, {t.bar}), core::InputError) << seed;
  }
}

} // namespace
} // namespace fissura::test
