#include <gtest/gtest.h>

#include <set>

#include "fissura/core/error.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/box.hpp"
#include "fissura/mesh/faces.hpp"
#include "fissura/model/select.hpp"

namespace fissura::model {
namespace {

using Kind = Selector::Kind;

/// A beam of 4 x 2 x 2 cells of 0.1 m with a plate of one cell length on top, and a curve outside the tets.
mesh::Mesh beam_with_plate() {
  std::vector<mesh::BoxCells> b(2);
  b[0].name = "beam", b[0].to = {0.4, 0.2, 0.2}, b[0].cells = {4, 2, 2};
  b[1].name = "plate", b[1].from = {0.1, 0, 0.2}, b[1].to = {0.2, 0.2, 0.25}, b[1].cells = {1, 2, 1};
  mesh::Mesh m = mesh::make_boxes(b);
  int const n = static_cast<int>(m.points.size());
  m.points.push_back({0.05, 0.05, 0.05});
  m.points.push_back({0.35, 0.05, 0.05});
  m.line_groups.push_back({"bar", {{n, n + 1}}});
  m.point_groups.push_back({"tip", {0}});
  return m;
}

Selector select(Kind kind) {
  Selector s;
  s.kind = kind;
  s.place = {"case.toml", 12, 3};
  return s;
}
Selector group(std::string name) {
  Selector s = select(Kind::group);
  s.group = std::move(name);
  return s;
}
Selector plane(int axis, double at) {
  Selector s = select(Kind::plane);
  s.axis = axis, s.at = at;
  return s;
}
Selector between(Kind kind, Vec3 from, Vec3 to, double tolerance = 0) {
  Selector s = select(kind);
  s.from = from, s.to = to, s.tolerance = tolerance;
  return s;
}

template <class Function> std::string refusal(Function f) {
  try {
    f();
  } catch (core::InputError const& error) {
    EXPECT_EQ(core::to_string(error.diagnostics.at(0).place), "case.toml:12:3");
    return error.diagnostics[0].message;
  }
  return "";
}

// Requirement: geometric selectors pick exactly the points within their tolerance, by rising index.
TEST(SelectPoints, by_geometry) {
  mesh::Mesh const m = beam_with_plate();
  EXPECT_EQ(select_points(m, plane(0, 0.1)).size(), 3u * 3 + 3);
  EXPECT_EQ(select_points(m, plane(0, 0.1 + 3e-7)).size(), 12u); // within 1e-6 of the extent of 0.4 m
  EXPECT_EQ(select_points(m, between(Kind::line, {0, 0, 0}, {0.25, 0, 0})).size(), 3u);
  EXPECT_EQ(select_points(m, between(Kind::line, {0, 0, 0}, {0.25, 0, 0}, 0.06)).size(), 4u);
  EXPECT_EQ(select_points(m, between(Kind::box, {0.1, 0.2, 0.2}, {-1, -1, 0.2})).size(), 2u * 3);
  auto const all = select_points(m, select(Kind::all));
  EXPECT_EQ(all.size(), m.points.size() - 2); // not the points of the curve, which belong to no tet
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
}

// Requirement: a point without a tolerance picks the nearest point, with one all points within it.
TEST(SelectPoints, nearest_point) {
  mesh::Mesh const m = beam_with_plate();
  auto const nearest = select_points(m, between(Kind::point, {0.31, 0.09, 0.22}, {}));
  ASSERT_EQ(nearest.size(), 1u);
  EXPECT_LT(core::norm(m.points[nearest[0]] - Vec3{0.3, 0.1, 0.2}), 1e-12);
  EXPECT_EQ(select_points(m, between(Kind::point, {0.3, 0.1, 0.1}, {}, 0.11)).size(), 7u);
}

// Requirement: groups of every kind pick their points.
TEST(SelectPoints, by_group) {
  mesh::Mesh const m = beam_with_plate();
  EXPECT_EQ(select_points(m, group("plate")).size(), 2u * 3 * 2);
  EXPECT_EQ(select_points(m, group("beam")).size(), 5u * 3 * 3);
  EXPECT_EQ(select_points(m, group("beam.x-")).size(), 9u);
  EXPECT_EQ(select_points(m, group("tip")), std::vector<int>{0});
}

// Requirement: a name that groups of two kinds have is refused with both and the way to say which, unless
// they select the same; the kind before the name says which.
TEST(SelectPoints, one_name_of_two_kinds) {
  auto m = beam_with_plate();
  for (auto const& side : m.face_groups)
    if (side.name == "beam.x-") m.face_groups.push_back({"beam", side.triangles});
  auto const adjacency = make_adjacency(m);
  EXPECT_EQ(
      refusal([&] { select_points(m, group("beam")); }),
      "the name 'beam' stands for a volume group (45 nodes) and a surface group (9 nodes) of the mesh: write "
      "\"volume:beam\" or \"surface:beam\"");
  EXPECT_EQ(select_points(m, group("volume:beam")).size(), 45u);
  EXPECT_EQ(select_points(m, group("surface:beam")).size(), 9u);
  EXPECT_NE(refusal([&] {
              select_boundary_faces(m, adjacency, group("beam"));
            }).find("and a surface group (8 outer faces)"),
            std::string::npos);
  EXPECT_EQ(select_boundary_faces(m, adjacency, group("surface:beam")).size(), 8u);
  EXPECT_EQ(select_shared_faces(m, adjacency, group("beam")),
            select_shared_faces(m, adjacency, group("volume:beam")))
      << "an outer surface has no joints";
  EXPECT_EQ(select_tets(m, group("beam")).size(), 16u * 6) << "only a volume has tets";
  EXPECT_TRUE(names_tets(m, group("beam")));
  EXPECT_FALSE(names_tets(m, group("surface:beam")));
  EXPECT_NE(refusal([&] { select_points(m, group("curve:beam")); }).find("no group 'curve:beam'"),
            std::string::npos);
  m.point_groups.push_back({"plate", {}});
  for (int p = 0; p < static_cast<int>(m.points.size()); ++p)
    if (m.points[static_cast<std::size_t>(p)].z > 0.24) m.point_groups.back().points.push_back(p);
  EXPECT_NE(refusal([&] { select_points(m, group("plate")); }).find("\"point:plate\""), std::string::npos);
  for (int const p : select_points(m, group("volume:plate"))) m.point_groups.back().points.push_back(p);
  EXPECT_EQ(select_points(m, group("plate")).size(), 12u) << "both are the same nodes";
}

// Requirement: an unknown group is refused with the nearest name and the list; an empty selection with the
// extent.
TEST(SelectPoints, refusals_help) {
  mesh::Mesh const m = beam_with_plate();
  std::string const unknown = refusal([&] { select_points(m, group("beam.x_")); });
  EXPECT_NE(unknown.find("no group 'beam.x_' (did you mean 'beam.x-'?); its groups: beam, plate, beam.x-"),
            std::string::npos)
      << unknown;
  EXPECT_EQ(
      refusal([&] { select_points(m, plane(2, 7)); }),
      "plane z = 7 m selects no point of a tet; the model reaches from (0, 0, 0) to (0.4, 0.2, 0.25) m");
  EXPECT_NE(refusal([&] { select_points(m, group("bar")); }).find("selects no point of a tet"),
            std::string::npos);
  EXPECT_EQ(refusal([&] { select_points(m, group("zzzzzzzzzzzz")); }).find("did you mean"),
            std::string::npos);
}

double area_of(mesh::Mesh const& m, std::vector<mesh::TetFace> const& faces) {
  double sum = 0;
  for (auto const f : faces) sum += geometry::area(mesh::face_triangle(m, f));
  return sum;
}

// Requirement: faces are selected by their three points, by surface group exactly, by volume group its outer
// faces.
TEST(SelectFaces, by_geometry_and_group) {
  mesh::Mesh const m = beam_with_plate();
  auto const adjacency = mesh::make_adjacency(m);
  EXPECT_NEAR(area_of(m, select_boundary_faces(m, adjacency, plane(2, 0))), 0.08, 1e-14);
  EXPECT_NEAR(area_of(m, select_boundary_faces(m, adjacency, plane(2, 0.2))), 0.06,
              1e-14); // not below the plate
  EXPECT_NEAR(area_of(m, select_boundary_faces(m, adjacency, group("beam.x+"))), 0.04, 1e-14);
  EXPECT_NEAR(area_of(m, select_boundary_faces(m, adjacency, group("plate"))), 0.02 + 2 * 0.05 * 0.3, 1e-14);
  EXPECT_NEAR(area_of(m, select_boundary_faces(m, adjacency, select(Kind::all))), 0.4 + 2 * 0.05 * 0.3,
              1e-13);
}

// Requirement: faces inside the body, curves and empty results are refused for loads on faces.
TEST(SelectFaces, refusals) {
  mesh::Mesh const m = beam_with_plate();
  auto const adjacency = mesh::make_adjacency(m);
  EXPECT_NE(refusal([&] {
              select_boundary_faces(m, adjacency, group("beam.z+"));
            }).find("4 of the 16 triangles of group 'beam.z+' are not on the boundary"),
            std::string::npos);
  EXPECT_NE(refusal([&] { select_boundary_faces(m, adjacency, group("bar")); }).find("'bar' has no faces"),
            std::string::npos);
  EXPECT_NE(refusal([&] { select_boundary_faces(m, adjacency, plane(0, 0.3)); }).find("no boundary face"),
            std::string::npos);
}

// Requirement: tets are selected by centroid or volume group.
TEST(SelectTets, by_centroid_and_group) {
  mesh::Mesh const m = beam_with_plate();
  EXPECT_EQ(select_tets(m, between(Kind::box, {0, 0, 0}, {0.1, 0.2, 0.2})).size(), 4u * 6);
  EXPECT_EQ(select_tets(m, group("plate")).size(), 2u * 6);
  EXPECT_EQ(select_tets(m, select(Kind::all)).size(), 18u * 6);
  EXPECT_EQ(select_tets(m, between(Kind::point, {0.01, 0.15, 0.22}, {})).size(), 1u);
  EXPECT_NE(refusal([&] { select_tets(m, group("beam.x-")); }).find("name a volume group"),
            std::string::npos);
}

// Requirement: joints are selected by centroid, by volume group (either tet) and by a surface group inside
// the body.
TEST(SelectJoints, by_centroid_and_group) {
  mesh::Mesh const m = beam_with_plate();
  auto const adjacency = mesh::make_adjacency(m);
  EXPECT_EQ(select_shared_faces(m, adjacency, plane(0, 0.2)).size(), 8u);
  EXPECT_EQ(select_shared_faces(m, adjacency, group("plate.z-")).size(), 4u);
  // Two cells with 6 inner faces each, 2 faces between them, 4 on the beam.
  EXPECT_EQ(select_shared_faces(m, adjacency, group("plate")).size(), 2u * 6 + 2 + 4);
  EXPECT_EQ(select_shared_faces(m, adjacency, select(Kind::all)).size(), adjacency.shared.size());
}

// Requirement: the predicate for places honours the selector's own tolerance before the fallback.
TEST(Inside, tolerances) {
  EXPECT_TRUE(inside(plane(1, 0.5), {9, 0.51, 9}, 0.02));
  EXPECT_FALSE(inside(plane(1, 0.5), {9, 0.53, 9}, 0.02));
  EXPECT_FALSE(inside(between(Kind::point, {0, 0, 0}, {}, 0.1), {0.2, 0, 0}, 1));
  EXPECT_TRUE(inside(between(Kind::line, {0, 0, 0}, {1, 0, 0}), {1.01, 0, 0}, 0.02));
  EXPECT_TRUE(inside(between(Kind::box, {1, 1, 1}, {0, 0, 0}), {0.5, 1, 0}, 1e-9));
  EXPECT_FALSE(inside(group("beam"), {0, 0, 0}, 1));
}

} // namespace
} // namespace fissura::model
