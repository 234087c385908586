// Broken meshes: each must be refused with an error that names the place.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "fissura/core/error.hpp"
#include "fissura/mesh/box.hpp"
#include "fissura/mesh/check.hpp"

namespace fissura::mesh {
namespace {

/// Two tets on the triangle (0, 1, 2), numbered 11 and 12 in the input.
Mesh two_tets() {
  Mesh m;
  m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  m.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  m.tet_group = {0, 0};
  m.volume_groups = {"concrete"};
  m.input_id = {11, 12};
  return m;
}

Mesh boxes(std::array<int, 3> lower_cells, std::array<int, 3> upper_cells, int upper_tets_per_cell = 6) {
  std::vector<BoxCells> b(2);
  b[0].name = "lower", b[0].to = {1, 1, 1}, b[0].cells = lower_cells;
  b[1].name = "upper", b[1].from = {0, 0, 1}, b[1].to = {1, 1, 2}, b[1].cells = upper_cells;
  b[1].tets_per_cell = upper_tets_per_cell;
  return make_boxes(b);
}

/// The message of the error, or "" where none was thrown.
std::string refusal(Mesh const& m) {
  try {
    check_mesh(m, {"beam.msh", 0, 0});
  } catch (core::InputError const& error) {
    EXPECT_EQ(error.failure, core::Failure::input);
    std::string all;
    for (auto const& d : error.diagnostics) {
      EXPECT_EQ(d.place.file, "beam.msh");
      all += d.message + "\n";
    }
    return all;
  }
  return "";
}

void expect_refusal(Mesh const& m, std::vector<std::string> const& parts) {
  std::string const message = refusal(m);
  for (auto const& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' in: " << message;
}

// Requirement: sound meshes pass, also with matching touching boxes and with points that nothing uses.
TEST(CheckMesh, sound_meshes_pass) {
  EXPECT_EQ(refusal(two_tets()), "");
  EXPECT_EQ(refusal(boxes({2, 2, 2}, {2, 2, 3})), "");
  Mesh m = two_tets();
  m.points.push_back({9, 9, 9});
  EXPECT_EQ(refusal(m), "");
}

// Requirement: a mesh without tets is refused.
TEST(CheckMesh, no_tets) {
  Mesh m;
  expect_refusal(m, {"no tets"});
}

// Requirement: a coordinate that is not a finite number is refused with the point's number.
TEST(CheckMesh, coordinate_not_finite) {
  Mesh m = two_tets();
  m.points[3].y = std::numeric_limits<double>::quiet_NaN();
  expect_refusal(m, {"not finite", "point 3"});
}

// Requirement: a tet with a corner that does not exist is refused with its input number.
TEST(CheckMesh, corner_does_not_exist) {
  Mesh m = two_tets();
  m.tets[1][3] = 77;
  expect_refusal(m, {"no point of the mesh", "tet 12"});
}

// Requirement: a group of any kind with a point that does not exist is refused by name, and so is an empty
// one.
TEST(CheckMesh, groups_of_points_that_do_not_exist) {
  Mesh m = two_tets();
  m.face_groups = {{"top", {{0, 1, 77}}}};
  m.line_groups = {{"bar", {{0, -1}}}};
  m.point_groups = {{"tip", {5}}, {"none", {}}};
  expect_refusal(m, {"surface group 'top' has a point that is no point of the mesh",
                     "curve group 'bar' has a point that is no point of the mesh",
                     "point group 'tip' has a point that is no point of the mesh",
                     "point group 'none' is empty"});
}

// Requirement: an inverted tet is refused with its input number and centroid.
TEST(CheckMesh, inverted_tet) {
  Mesh m = two_tets();
  std::swap(m.tets[1][0], m.tets[1][1]);
  expect_refusal(m, {"inverted tets (negative volume): 1 (", "tet 12 at (0.25, 0.25, -0.25) m"});
}

// Requirement: a flat tet is refused, also when rounding leaves it a trace of volume of either sign.
TEST(CheckMesh, flat_tet) {
  for (double z : {0.0, 1e-9, -1e-9}) {
    Mesh m = two_tets();
    m.points[3] = {0.4, 0.4, z};
    expect_refusal(m, {"tets without volume: 1 (", "tet 11 at (0.35, 0.35"});
  }
}

// Requirement: a tet that names one point twice has no volume and is refused.
TEST(CheckMesh, repeated_corner) {
  Mesh m = two_tets();
  m.tets[0] = {0, 1, 2, 2};
  expect_refusal(m, {"tets without volume", "tet 11"});
}

// Requirement: a tet listed twice is refused with both numbers and the usual reason.
TEST(CheckMesh, duplicate_tet) {
  Mesh m = two_tets();
  m.tets.push_back({1, 2, 0, 3});
  m.tet_group.push_back(0);
  m.input_id.push_back(13);
  expect_refusal(
      m, {"tets stand twice: a volume in two physical groups?", "Duplicate tets: 1 (", "tets 11 and 13"});
}

// Requirement: three tets on one face are refused with their numbers and the face's place.
TEST(CheckMesh, three_tets_on_a_face) {
  Mesh m = two_tets();
  m.points.push_back({0.5, 0.5, 0.5});
  m.tets.push_back({0, 1, 2, 5});
  m.tet_group.push_back(0);
  m.input_id.push_back(13);
  expect_refusal(m, {"3 tets share one face at (0.333333, 0.333333, 0) m", "11, 12, 13"});
}

// Requirement: two positive tets on the same side of their common face overlap and are refused.
TEST(CheckMesh, folded_tets) {
  Mesh m = two_tets();
  m.points[4] = {0.3, 0.3, 2};
  m.tets[1] = {0, 1, 2, 4};
  expect_refusal(m, {"overlap: 1 (", "same side of their common face", "tets 11 and 12"});
}

// Requirement: touching boxes whose cells differ in number hang on each other and are refused with the place.
TEST(CheckMesh, boxes_with_different_cells) {
  expect_refusal(boxes({2, 2, 2}, {3, 2, 2}), {"overlap without matching", ", 1) m", "boxes must match"});
  EXPECT_EQ(refusal(boxes({2, 2, 2}, {2, 2, 2})), "");
}

// Requirement: a node of one box in the middle of a larger face of the other is refused.
TEST(CheckMesh, node_inside_a_face) {
  expect_refusal(boxes({1, 1, 1}, {1, 1, 1}, 24), {"overlap without matching", ", 1) m"});
}

// Requirement: a node that halves the edge of a neighbour's face is refused.
TEST(CheckMesh, node_on_an_edge) {
  Mesh m = two_tets();
  m.points.push_back({0.5, 0, 0}); // halves the edge 0-1 of tet 11 only
  m.tets = {{0, 5, 2, 3}, {5, 1, 2, 3}, {0, 2, 1, 4}};
  m.tet_group = {0, 0, 0};
  m.input_id = {11, 13, 12};
  expect_refusal(m, {"pairs of boundary faces that overlap without matching", "): 2 (", "tets 11 and 12",
                     "tets 13 and 12"});
}

// Requirement: two squares that meet with crossed diagonals are refused although all their corners match.
TEST(CheckMesh, crossed_diagonals) {
  Mesh m;
  m.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}};
  m.tets = {{0, 1, 2, 4}, {0, 2, 3, 4}, {0, 3, 1, 5}, {1, 3, 2, 5}};
  m.tet_group = {0, 0, 0, 0};
  m.volume_groups = {"concrete"};
  m.input_id = {1, 2, 3, 4};
  expect_refusal(m, {"pairs of boundary faces that overlap without matching", "): 4 (", "tets 1 and 3"});
}

// Requirement: empty named groups of every kind are refused by name.
TEST(CheckMesh, empty_groups) {
  Mesh m = two_tets();
  m.volume_groups.push_back("plate");
  m.face_groups.push_back({"grip", {}});
  m.line_groups.push_back({"bar", {}});
  m.point_groups.push_back({"tip", {}});
  expect_refusal(m, {"volume group 'plate' is empty", "surface group 'grip' is empty",
                     "curve group 'bar' is empty", "point group 'tip' is empty"});
}

// Requirement: a surface group off the tets' faces is refused with its name and place.
TEST(CheckMesh, surface_group_off_the_tets) {
  Mesh m = two_tets();
  m.points.push_back({3, 0, 0});
  m.face_groups.push_back({"grip", {{0, 1, 3}, {0, 1, 5}}});
  expect_refusal(m,
                 {"triangles of surface group 'grip' that are no faces of tets: 1 (", "(1.33333, 0, 0) m"});
}

// Requirement: a tet without a volume group is refused.
TEST(CheckMesh, tet_without_group) {
  Mesh m = two_tets();
  m.tet_group[1] = 5;
  expect_refusal(m, {"no volume group", "tet 12"});
}

// Requirement: impossible and overlapping boxes are refused with the box's name and place in the deck.
TEST(MakeBoxes, impossible_boxes) {
  auto const refused = [](std::function<void(std::vector<BoxCells>&)> spoil) -> std::string {
    std::vector<BoxCells> b(2);
    b[0].name = "beam", b[0].to = {1, 1, 1};
    b[1].name = "plate", b[1].from = {0, 0, 1}, b[1].to = {1, 1, 2}, b[1].place = {"case.toml", 7, 1};
    spoil(b);
    try {
      make_boxes(b);
    } catch (core::InputError const& error) {
      return core::to_string(error.diagnostics.at(0).place) + ": " + error.diagnostics[0].message;
    }
    return "";
  };
  EXPECT_EQ(refused([](auto&) {}), "");
  EXPECT_EQ(refused([](auto& b) { b[1].from.z = 0.5; }),
            "case.toml:7:1: box 'plate': overlaps box 'beam' between (0, 0, 0.5) and (1, 1, 1) m");
  EXPECT_EQ(refused([](auto& b) { b[1].to.y = 0; }),
            "case.toml:7:1: box 'plate': no extent along y: both corners are at 0 m");
  EXPECT_EQ(refused([](auto& b) { b[1].cells[2] = 0; }),
            "case.toml:7:1: box 'plate': 0 cells along z, at least 1 is needed");
  EXPECT_EQ(refused([](auto& b) { b[1].tets_per_cell = 5; }),
            "case.toml:7:1: box 'plate': 5 tets per cell: only 6 and 24 are known");
  EXPECT_NE(refused([](auto& b) { b[1].grading[0] = -1; }).find("grading -1 along x"), std::string::npos);
  EXPECT_NE(refused([](auto& b) {
              b[1].cells = {100000, 100000, 100000};
            }).find("6e+15 tets"),
            std::string::npos);
  std::vector<BoxCells> const none;
  EXPECT_THROW(make_boxes(none), core::InputError);
}

} // namespace
} // namespace fissura::mesh
