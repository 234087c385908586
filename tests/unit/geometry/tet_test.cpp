#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "fissura/geometry/clip.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/geometry/triangle.hpp"

namespace fissura::geometry {
namespace {

Tet const unit_corner{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
Tet const regular{Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}; // edge 2 sqrt(2)
Tet const skew{Vec3{0.1, 0.2, -0.3}, Vec3{1.3, 0.1, 0.2}, Vec3{0.4, 1.7, 0.1}, Vec3{0.2, 0.5, 0.9}};

// Requirement: the measures of a regular tet agree with the closed forms for its edge.
TEST(Tet, measures_of_the_regular_tet) {
  double const edge = 2 * std::numbers::sqrt2;
  double const v = std::abs(volume(regular));
  EXPECT_NEAR(v, edge * edge * edge / (6 * std::numbers::sqrt2), 1e-14);
  EXPECT_NEAR(regular_edge(v), edge, 1e-14);
  Tet const positive = volume(regular) > 0 ? regular : Tet{regular[0], regular[2], regular[1], regular[3]};
  for (double h : altitudes(positive)) EXPECT_NEAR(h, edge * std::sqrt(2.0 / 3), 1e-14);
  for (double a : dihedral_angles(positive)) EXPECT_NEAR(a, std::acos(1.0 / 3), 1e-14);
  EXPECT_NEAR(mean_ratio(positive), 1, 1e-14);
  EXPECT_NEAR(longest_edge(positive), edge, 1e-14);
}

// Requirement: dihedral angles are listed at edges 01, 02, 03, 12, 13, 23; in the corner of a cube the first
// three are right.
TEST(Tet, dihedral_angles_of_a_cube_corner) {
  auto const a = dihedral_angles(unit_corner);
  for (int e = 0; e < 3; ++e) EXPECT_NEAR(a[e], std::numbers::pi / 2, 1e-15);
  for (int e = 3; e < 6; ++e) EXPECT_NEAR(a[e], std::acos(1 / std::sqrt(3.0)), 1e-15);
  EXPECT_NEAR(smallest_dihedral_angle(unit_corner), std::acos(1 / std::sqrt(3.0)), 1e-15);
}

// Requirement: a flat tet has zero altitude, zero quality and a zero dihedral angle; an inverted one has
// negative volume.
TEST(Tet, flat_and_inverted) {
  Tet const flat{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}};
  EXPECT_EQ(volume(flat), 0);
  EXPECT_EQ(smallest_altitude(flat), 0);
  EXPECT_EQ(mean_ratio(flat), 0);
  EXPECT_NEAR(smallest_dihedral_angle(flat), 0, 1e-15);
  EXPECT_LT(volume({skew[1], skew[0], skew[2], skew[3]}), 0);
}

// Requirement: outward face area vectors close, and the edge matrix times its inverse is the identity.
TEST(Tet, faces_close_and_edge_matrix_inverts) {
  auto const f = face_area_vectors(skew);
  EXPECT_LT(core::norm(f[0] + f[1] + f[2] + f[3]), 1e-15);
  for (int k = 0; k < 4; ++k) EXPECT_GT(core::dot(f[k], centroid(skew) - skew[k]), 0);
  Mat3 const one = edge_matrix(skew) * inverse_edge_matrix(skew) - Mat3::identity();
  EXPECT_LT(core::contract(one, one), 1e-28);
}

// Requirement: barycentric coordinates sum to one and give the point back, inside and outside.
TEST(Tet, barycentric_round_trip) {
  for (Vec3 p : {Vec3{0.5, 0.5, 0.2}, Vec3{-3, 2, 7}, skew[2]}) {
    auto const l = barycentric(skew, p);
    EXPECT_NEAR(std::accumulate(l.begin(), l.end(), 0.0), 1, 1e-13);
    EXPECT_LT(core::norm(at(skew, l) - p), 1e-13);
  }
}

// Requirement: triangle area, normal, centroid and barycentric coordinates (of the projection) match a hand
// example.
TEST(Triangle, hand_example) {
  Triangle const t{Vec3{0, 0, 1}, Vec3{2, 0, 1}, Vec3{0, 3, 1}};
  EXPECT_NEAR(area(t), 3, 1e-15);
  EXPECT_EQ(normal(t), (Vec3{0, 0, 1}));
  EXPECT_LT(core::norm(centroid(t) - Vec3{2.0 / 3, 1, 1}), 1e-15);
  auto const l = barycentric(t, {0.5, 1.5, 9});
  EXPECT_NEAR(l[0], 0.25, 1e-15);
  EXPECT_NEAR(l[1], 0.25, 1e-15);
  EXPECT_NEAR(l[2], 0.5, 1e-15);
  EXPECT_NEAR(longest_edge(t), std::sqrt(13.0), 1e-15);
}

// Requirement: the common area of two triangles is exact for shifted, turned, disjoint and touching pairs.
TEST(Triangle, overlap_area) {
  Triangle const t{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  EXPECT_NEAR(overlap_area(t, t), 0.5, 1e-15);
  EXPECT_NEAR(overlap_area(t, {t[0], t[2], t[1]}), 0.5, 1e-15);
  EXPECT_NEAR(overlap_area(t, {Vec3{0.5, 0, 0}, Vec3{1.5, 0, 0}, Vec3{0.5, 1, 0}}), 0.125, 1e-15);
  EXPECT_NEAR(overlap_area(t, {Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}), 0, 1e-15);
  EXPECT_NEAR(overlap_area(t, {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}}), 0.25, 1e-15);
  EXPECT_EQ(overlap_area(t, {Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{5, 1, 0}}), 0);
}

// Requirement: a segment is cut at the faces it enters and leaves; its own ends inside the tet carry face -1.
TEST(Clip, segment_in_tet) {
  auto const through = clip_to_tet(unit_corner, {-1, 0.25, 0.25}, {1, 0.25, 0.25});
  ASSERT_TRUE(through);
  EXPECT_NEAR(through->begin, 0.5, 1e-15);
  EXPECT_NEAR(through->end, 0.75, 1e-15);
  EXPECT_EQ(through->enter_face, 1);
  EXPECT_EQ(through->exit_face, 0);
  auto const inside = clip_to_tet(unit_corner, {0.1, 0.1, 0.1}, {0.2, 0.2, 0.2});
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->begin, 0);
  EXPECT_EQ(inside->end, 1);
  EXPECT_EQ(inside->enter_face, -1);
  EXPECT_EQ(inside->exit_face, -1);
  EXPECT_FALSE(clip_to_tet(unit_corner, {-1, 0.6, 0.6}, {1, 0.6, 0.6}));
  EXPECT_FALSE(clip_to_tet(unit_corner, {0.5, 0.6, 0.6}, {1, 0.6, 0.6}));
}

// Requirement: a segment crosses a triangle at the right parameter and place, and not beyond its ends or
// edges.
TEST(Clip, segment_through_triangle) {
  Triangle const t{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  auto const hit = cross_triangle(t, {0.2, 0.3, 1}, {0.2, 0.3, -3});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->s, 0.25, 1e-15);
  EXPECT_NEAR(hit->barycentric[1], 0.2, 1e-15);
  EXPECT_NEAR(hit->barycentric[2], 0.3, 1e-15);
  EXPECT_FALSE(cross_triangle(t, {0.2, 0.3, 1}, {0.2, 0.3, 0.5}));
  EXPECT_FALSE(cross_triangle(t, {0.8, 0.8, 1}, {0.8, 0.8, -1}));
  EXPECT_FALSE(cross_triangle(t, {0, 0, 1}, {1, 0, 1}));
}

// Requirement: the distance to a segment is measured to its ends beyond them, and to the point where it has
// no length.
TEST(Clip, distance_to_segment) {
  EXPECT_NEAR(distance_to_segment({0.5, 2, 0}, {0, 0, 0}, {1, 0, 0}), 2, 1e-15);
  EXPECT_NEAR(distance_to_segment({4, 4, 0}, {0, 0, 0}, {1, 0, 0}), 5, 1e-15);
  EXPECT_NEAR(distance_to_segment({3, 4, 0}, {0, 0, 0}, {0, 0, 0}), 5, 1e-15);
}

} // namespace
} // namespace fissura::geometry
