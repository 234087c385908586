#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "fissura/contact/polyhedron.hpp"
#include "fissura/contact/tet_overlap.hpp"
#include "support/random_mesh.hpp"

namespace fissura::contact {
namespace {

using Tet = std::array<Vec3, 4>;
Tet const corner{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

Tet moved(Tet t, Vec3 by) {
  for (auto& x : t) x += by;
  return t;
}
double six_volumes(Tet const& t) {
  return dot(t[1] - t[0], cross(t[2] - t[0], t[3] - t[0]));
}
/// A tet of random shape, not too flat, around a point.
Tet random_tet(support::Random& random, Vec3 centre) {
  for (;;) {
    Tet t;
    for (auto& x : t) x = centre + random.vector(-0.5, 0.5);
    if (six_volumes(t) < 0) std::swap(t[0], t[1]);
    if (six_volumes(t) > 0.05) return t;
  }
}
TetNow unstrained(Tet const& t) {
  return make_tet_now(t, t);
}

// Requirement: a tet cut by a plane near a corner loses the similar tet at that corner, volume and centroid.
TEST(Polyhedron, loses_what_a_plane_cuts_off) {
  Polyhedron p(corner);
  EXPECT_NEAR(p.solid().volume, 1.0 / 6, 1e-15);
  std::array<double, Polyhedron::capacity> value{};
  for (int i = 0; i < p.count(); ++i) value[i] = p[i].x - 0.75; // keeps the corner at x = 1
  p.keep_positive(value);
  auto const s = p.solid();
  EXPECT_NEAR(s.volume, 1.0 / 6 / 64, 1e-15);
  EXPECT_NEAR(s.centroid.x, 0.75 + 0.25 / 4, 1e-14);
  EXPECT_NEAR(s.centroid.y, 0.25 / 4, 1e-14);
  for (int i = 0; i < p.count(); ++i) value[i] = -1;
  p.keep_positive(value);
  EXPECT_TRUE(p.empty());
}

// Requirement: cutting by a plane through corners and edges, where values are exactly zero, keeps a closed
// body.
TEST(Polyhedron, stays_closed_when_a_plane_goes_through_its_corners) {
  Polyhedron p(corner);
  std::array<double, Polyhedron::capacity> value{};
  for (int turn = 0; turn < 3; ++turn) { // twice the same plane: x = y through two corners
    for (int i = 0; i < p.count(); ++i) value[i] = p[i].x - p[i].y;
    p.keep_positive(value);
    EXPECT_NEAR(p.solid().volume, 1.0 / 12, 1e-15);
  }
}

// Requirement: a tet overlaps itself by its volume, and both orders of a pair give the same overlap.
TEST(TetOverlap, measures_the_common_volume) {
  EXPECT_NEAR(overlap(unstrained(corner), unstrained(corner)).volume, 1.0 / 6, 1e-15);
  auto const half = overlap(unstrained(corner), unstrained(moved(corner, {0.5, 0, 0})));
  EXPECT_NEAR(half.volume, 1.0 / 6 / 8, 1e-15); // the corner at x = 1, halved in size
  support::Random random(3);
  for (int i = 0; i < 200; ++i) {
    auto const a = unstrained(random_tet(random, {})),
               b = unstrained(random_tet(random, random.vector(-0.3, 0.3)));
    auto const ab = overlap(a, b), ba = overlap(b, a);
    EXPECT_NEAR(ab.volume, ba.volume, 1e-14);
    EXPECT_NEAR(ab.energy, ba.energy, 1e-14);
    EXPECT_NEAR(norm(ab.force + ba.force), 0, 1e-13);
  }
}

// Requirement: two flat faces that overlap by a small depth g over an area A hold A g^2 and push with 2 A g.
TEST(TetOverlap, is_a_linear_spring_between_flat_faces) {
  double const g = 1e-5;
  Tet const below{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0.2, 0.2, -1}};
  Tet const above{Vec3{0, 0, -g}, Vec3{0, 1, -g}, Vec3{1, 0, -g}, Vec3{0.2, 0.2, 1}};
  auto const a = unstrained({below[0], below[2], below[1], below[3]}),
             b = unstrained({above[0], above[2], above[1], above[3]});
  auto const o = overlap(a, b);
  EXPECT_NEAR(o.energy, 0.5 * g * g, 0.5 * g * g * 1e-4);
  EXPECT_NEAR(o.force.z, 2 * 0.5 * g, 0.5 * g * 1e-3);
}

// Requirement: the forces on all eight corners are minus the gradient of the energy, for every kind of
// overlap.
TEST(TetOverlap, forces_are_the_gradient_of_the_energy) {
  support::Random random(11);
  int tried = 0;
  for (int i = 0; i < 100; ++i) {
    Tet const ra = random_tet(random, {}), rb = random_tet(random, random.vector(-0.4, 0.4));
    Tet a = ra, b = rb; // moved a little from where they were: the stretches are not 1
    for (auto& x : a) x += random.vector(-0.03, 0.03);
    for (auto& x : b) x += random.vector(-0.03, 0.03);
    auto energy = [&] { return overlap(make_tet_now(a, ra), make_tet_now(b, rb)).energy; };
    auto const o = overlap(make_tet_now(a, ra), make_tet_now(b, rb));
    if (o.energy <= 0) continue;
    ++tried;
    double const step = 1e-5, tolerance = 1e-6 * std::max(norm(o.force), 1e-3);
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 3; ++r)
        for (bool const of_a : {true, false}) {
          double& x = of_a ? a[c][r] : b[c][r];
          double const here = x;
          x = here + step;
          double const more = energy();
          x = here - step;
          double const less = energy();
          x = here;
          EXPECT_NEAR((of_a ? o.on_a : o.on_b)[c][r], -(more - less) / (2 * step), tolerance);
        }
  }
  EXPECT_GT(tried, 30);
}

// Requirement: the forces of a pair balance, and so do their moments.
TEST(TetOverlap, forces_and_moments_balance) {
  support::Random random(5);
  for (int i = 0; i < 100; ++i) {
    Tet const a = random_tet(random, {}), b = random_tet(random, random.vector(-0.4, 0.4));
    auto const o = overlap(unstrained(a), unstrained(b));
    Vec3 force, moment;
    double size = 0;
    for (int c = 0; c < 4; ++c) {
      force += o.on_a[c] + o.on_b[c];
      moment += cross(a[c], o.on_a[c]) + cross(b[c], o.on_b[c]);
      size += norm(o.on_a[c]) + norm(o.on_b[c]);
    }
    EXPECT_LE(norm(force), 1e-14 * size);
    EXPECT_LE(norm(moment), 1e-13 * size);
  }
}

// Requirement: tets that only touch, or are inside out, do not push.
TEST(TetOverlap, needs_a_common_volume) {
  EXPECT_EQ(overlap(unstrained(corner), unstrained(moved(corner, {1, 0, 0}))).energy, 0);
  Tet const mirrored{corner[1], corner[0], corner[2], corner[3]};
  EXPECT_EQ(overlap(unstrained(corner), make_tet_now(mirrored, corner)).energy, 0);
}

/// Distance of two tets, from above: of the closest points of two nets over their faces.
double distance_from_above(Tet const& a, Tet const& b) {
  constexpr int n = 12;
  auto const net = [](Tet const& t) {
    std::vector<Vec3> points;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        for (int k = 0; i + j + k <= n; ++k) {
          if (i != 0 && j != 0 && k != 0 && i + j + k != n) continue; // inside
          points.push_back(t[0] + (1.0 / n) * (i * (t[1] - t[0]) + j * (t[2] - t[0]) + k * (t[3] - t[0])));
        }
    return points;
  };
  double least = 1e300;
  auto const on_b = net(b);
  for (Vec3 const x : net(a))
    for (Vec3 const y : on_b) least = std::min(least, norm(x - y));
  return least;
}

// Requirement: the gap is never more than the distance, is 0 for tets that overlap, and is positive for tets
// that only a pair of edges keeps apart, which no face plane does.
TEST(GapBetween, is_a_bound_from_below_that_finds_every_gap) {
  support::Random random(11);
  int apart = 0, by_edges_alone = 0;
  for (int i = 0; i < 300; ++i) {
    Tet const a = random_tet(random, {}), b = random_tet(random, random.vector(-0.8, 0.8));
    double const gap = gap_between(a, b);
    EXPECT_LE(gap, distance_from_above(a, b) + 1e-15);
    EXPECT_NEAR(gap, gap_between(b, a), 1e-15);
    bool const touch = overlap(unstrained(a), unstrained(b)).volume > 0;
    EXPECT_EQ(gap > 0, !touch) << i;
    std::uint8_t separator = 0;
    apart += gap > 0;
    by_edges_alone += gap > 0 && !are_apart(a, b, separator);
  }
  EXPECT_GT(apart, 50);
  EXPECT_GT(by_edges_alone, 5);
}

// Requirement: the gap between tets that face each other flat, corner to face or edge to edge is their
// distance.
TEST(GapBetween, is_exact_where_a_normal_joins_the_closest_points) {
  EXPECT_NEAR(gap_between(corner, moved(corner, {0, 0, -1.25})), 0.25, 1e-15); // its apex below our base
  Tet const along_x{Vec3{-1, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, -1}, Vec3{0, -1, -1}};
  Tet const along_y{Vec3{0, -1, 0.3}, Vec3{0, 1, 0.3}, Vec3{1, 0, 1.3}, Vec3{-1, 0, 1.3}};
  EXPECT_NEAR(gap_between(along_x, along_y), 0.3, 1e-15);
}

} // namespace
} // namespace fissura::contact
