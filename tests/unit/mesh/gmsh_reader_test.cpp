#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "fissura/core/error.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/geometry/triangle.hpp"
#include "fissura/mesh/check.hpp"
#include "fissura/mesh/gmsh_reader.hpp"
#include "fissura/mesh/gmsh_session.hpp"
#include "fissura/mesh/quality.hpp"

namespace fissura::mesh {
namespace {

/// A file that lives as long as its test.
class Written {
 public:
  Written(std::string const& name, std::string const& text)
      : path(std::filesystem::temp_directory_path() / ("fissura_" + std::to_string(getpid()) + "_" + name)) {
    std::ofstream(path) << text;
  }
  ~Written() { std::filesystem::remove(path); }
  std::filesystem::path path;
};

/// Two tets on one triangle, the second of negative orientation, with a group of every dimension, an unnamed
/// physical surface 7 and a node (9) that nothing uses.
std::string const two_tets_2_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
4
0 4 "tip"
1 3 "bar"
2 2 "grip"
3 1 "concrete"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 10 0 0
3 0 10 0
4 0 0 10
5 0 0 -10
9 77 0 0
$EndNodes
$Elements
6
1 15 2 4 1 4
2 1 2 3 1 1 2
3 2 2 2 1 1 2 4
4 2 2 7 2 1 4 3
21 4 2 1 1 1 2 3 4
22 4 2 0 2 1 2 3 5
$EndElements
)";

std::string const two_tets_4_1 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
1
3 1 "concrete"
$EndPhysicalNames
$Entities
0 0 0 2
1 0 0 0 1 1 1 1 1 0
2 0 0 -1 1 1 0 0 0
$EndEntities
$Nodes
1 5 1 5
3 1 0 5
1
2
3
4
5
0 0 0
1 0 0
0 1 0
0 0 1
0 0 -1
$EndNodes
$Elements
2 2 31 32
3 1 4 1
31 1 2 3 4
3 2 4 1
32 1 3 2 5
$EndElements
)";

/// A block of 2 x 1 x 1 in two volumes with a curve and a point.
std::string const block_geo = R"(
lc = 0.4; // default size
Point(1) = {0, 0, 0, lc}; Point(2) = {1, 0, 0, lc}; Point(3) = {1, 1, 0, lc}; Point(4) = {0, 1, 0, lc};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
e[] = Extrude {0, 0, 1} { Surface{1}; };
f[] = Extrude {0, 0, 1} { Surface{e[0]}; };
Physical Volume("lower") = {e[1]}; Physical Volume("upper") = {f[1]};
Physical Surface("bottom") = {1}; Physical Surface(70) = {f[0]};
Physical Curve("edge") = {1}; Physical Point("tip") = {1};
)";

double volume_of_group(Mesh const& m, std::string const& name) {
  double sum = 0;
  for (int t = 0; t < static_cast<int>(m.tets.size()); ++t)
    if (m.volume_groups[m.tet_group[t]] == name) sum += geometry::volume(corners(m, t));
  return sum;
}

// Requirement: a 2.2 file gives points in metres, positive tets, element numbers and groups of every
// dimension; unnamed groups are called by number and tets without a group are in "default".
TEST(ReadGmsh, format_2_2) {
  Written const file("two.msh", two_tets_2_2);
  Mesh const m = read_gmsh(file.path, 1e-3, 0);
  EXPECT_NO_THROW(check_mesh(m));
  ASSERT_EQ(m.points.size(), 5u);
  EXPECT_NEAR(m.points[1].x, 0.01, 1e-17);
  ASSERT_EQ(m.tets.size(), 2u);
  for (int t = 0; t < 2; ++t) EXPECT_NEAR(geometry::volume(corners(m, t)), 1e-6 / 6, 1e-18);
  EXPECT_EQ(m.input_id, (std::vector<int>{21, 22}));
  EXPECT_EQ(m.volume_groups, (std::vector<std::string>{"concrete", "default"}));
  EXPECT_EQ(m.tet_group, (std::vector<int>{0, 1}));
  ASSERT_EQ(m.face_groups.size(), 2u);
  EXPECT_EQ(m.face_groups[0].name, "grip");
  EXPECT_EQ(m.face_groups[1].name, "7");
  EXPECT_EQ(m.face_groups[0].triangles, (std::vector<std::array<int, 3>>{{0, 1, 3}}));
  ASSERT_EQ(m.line_groups.size(), 1u);
  EXPECT_EQ(m.line_groups[0].segments, (std::vector<std::array<int, 2>>{{0, 1}}));
  ASSERT_EQ(m.point_groups.size(), 1u);
  EXPECT_EQ(m.point_groups[0].points, std::vector<int>{3});
}

// Requirement: a 4.1 file gives the same kind of mesh.
TEST(ReadGmsh, format_4_1) {
  Written const file("two4.msh", two_tets_4_1);
  Mesh const m = read_gmsh(file.path, 1, 0);
  EXPECT_NO_THROW(check_mesh(m));
  EXPECT_EQ(m.points.size(), 5u);
  EXPECT_EQ(m.input_id, (std::vector<int>{31, 32}));
  EXPECT_NEAR(volume_of_group(m, "concrete"), 1.0 / 6, 1e-15);
  EXPECT_NEAR(volume_of_group(m, "default"), 1.0 / 6, 1e-15);
}

// Requirement: a .geo is meshed in 3-D with its groups, conforming between volumes, silently and alike every
// time.
TEST(ReadGmsh, geometry) {
  Written const file("block.geo", block_geo);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Mesh const m = read_gmsh(file.path, 1, 0);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NO_THROW(check_mesh(m));
  EXPECT_NEAR(volume_of_group(m, "lower"), 1, 1e-12);
  EXPECT_NEAR(volume_of_group(m, "upper"), 1, 1e-12);
  EXPECT_EQ(measure_quality(m, make_adjacency(m)).open_interfaces, 0);
  ASSERT_EQ(m.face_groups.size(), 2u);
  EXPECT_EQ(m.face_groups[1].name, "70");
  for (auto const& g : m.face_groups) {
    double area = 0;
    for (auto const& t : g.triangles)
      area += geometry::area({m.points[t[0]], m.points[t[1]], m.points[t[2]]});
    EXPECT_NEAR(area, 1, 1e-12) << g.name;
  }
  EXPECT_EQ(m.line_groups.at(0).name, "edge");
  EXPECT_EQ(m.point_groups.at(0).points.size(), 1u);
  EXPECT_EQ(read_gmsh(file.path, 1, 0).points, m.points);
}

// Requirement: the element size of the case, in metres, governs the mesh of a .geo drawn in other units.
TEST(ReadGmsh, element_size) {
  Written const file("block.geo", block_geo);
  Mesh const m = read_gmsh(file.path, 0.5, 0.1); // a block of 1 x 0.5 x 0.5 m
  Quality const q = measure_quality(m, make_adjacency(m));
  EXPECT_NEAR(q.volume, 0.25, 1e-12);
  EXPECT_NEAR(q.mean_h, 0.1, 0.025);
}

/// Place and message of the refusal, or "".
std::string refusal(std::filesystem::path const& path, double unit = 1) {
  try {
    read_gmsh(path, unit, 0);
  } catch (core::InputError const& error) {
    auto const& d = error.diagnostics.at(0);
    EXPECT_EQ(d.place.file, path.string());
    return std::to_string(d.place.line) + ": " + d.message;
  }
  return "";
}
std::string refusal_of(std::string const& name, std::string const& text) {
  Written const file(name, text);
  return refusal(file.path);
}
std::string replaced(std::string text, std::string const& what, std::string const& with) {
  auto const at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}
void expect_part(std::string const& message, std::string const& part) {
  EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' in: " << message;
}

// Requirement: files that are missing, empty, of another kind or broken are refused at the file with the
// reason, and a good file is still read afterwards.
TEST(ReadGmsh, refuses_bad_files) {
  auto const folder =
      std::filesystem::temp_directory_path() / ("fissura-folder-" + std::to_string(::getpid()) + ".msh");
  std::filesystem::create_directory(folder);
  expect_part(refusal(folder), "the mesh file is not a regular file");
  std::filesystem::remove(folder);
  expect_part(refusal("/nowhere/beam.msh"), "no such mesh file");
  expect_part(refusal(std::filesystem::temp_directory_path()), "ends in .msh or .geo");
  expect_part(refusal_of("a.stl", "solid"), "ends in .msh or .geo");
  expect_part(refusal_of("a.msh", ""), "empty");
  expect_part(refusal_of("a.msh", "hello world\n"), "does not begin with $MeshFormat");
  expect_part(refusal_of("a.msh", std::string("\x7f\x45\x4c\x46\x00\xff\x80;;", 9)),
              "does not begin with $MeshFormat");
  expect_part(refusal_of("a.msh", replaced(two_tets_2_2, "2.2 0 8", "3.0 0 8")),
              "only the formats 2.2 and 4.1");
  expect_part(refusal_of("a.msh", replaced(two_tets_2_2, "22 4 2 0 2 1 2 3 5", "22 4 2 0 2 1 2 3 88")), "88");
  expect_part(refusal_of("a.msh", two_tets_2_2.substr(0, 200)), "21: the number of elements = 6, but");
  expect_part(refusal_of("a.msh", two_tets_4_1.substr(0, 260)), "30: expected a node of an element");
  expect_part(refusal_of("a.msh", replaced(two_tets_2_2, "$Elements\n6", "$Elements\n4")),
              "26: expected $EndElements, found '21'");
  Written const good("good.msh", two_tets_2_2);
  EXPECT_EQ(refusal(good.path), "");
  expect_part(refusal(good.path, 0), "length unit 0 m");
}

// Requirement: a file that puts a tet into two physical volumes, or names more groups than any mesh has, is
// refused.
TEST(ReadGmsh, refuses_groups_that_cannot_be) {
  std::string const two =
      replaced(replaced(two_tets_4_1, "1\n3 1 \"concrete\"", "2\n3 1 \"concrete\"\n3 2 \"steel\""),
               "1 0 0 0 1 1 1 1 1 0", "1 0 0 0 1 1 1 2 1 2 0");
  expect_part(refusal_of("a.msh", two), "volume 1 belongs to the physical volumes 'concrete', 'steel'");
  std::string many = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n100001\n";
  for (int i = 0; i < 100001; ++i) many += "3 1 \"c\"\n";
  expect_part(refusal_of("a.msh", many), "more than 100000 names");
}

// Requirement: a file larger than any mesh is refused before it is read.
TEST(ReadGmsh, refuses_a_file_of_many_gigabytes) {
  Written const file("large.msh", two_tets_2_2);
  std::filesystem::resize_file(file.path, (std::uintmax_t{8} << 30U) + 1); // takes no room on the disk
  expect_part(refusal(file.path), "the mesh file is larger than 8 GiB");
}

// Requirement: whatever gmsh throws becomes an error at the file with gmsh's words, the line among them.
TEST(GmshSession, turns_what_gmsh_throws_into_errors) {
  GmshSession const session("beam.geo");
  auto const said = [&](auto const& thrown) -> std::string {
    try {
      session.guard([&] { throw thrown; });
    } catch (core::InputError const& e) {
      return e.what();
    }
    return "nothing";
  };
  EXPECT_EQ(said(std::string("'beam.geo', line 12: no such curve")),
            "beam.geo:12: error: gmsh cannot make a mesh of this file: 'beam.geo', line 12: no such curve");
  EXPECT_EQ(said(std::runtime_error("out of luck")),
            "beam.geo: error: gmsh cannot make a mesh of this file: out of luck");
  EXPECT_EQ(said(7), "beam.geo: error: gmsh cannot make a mesh of this file: unknown error");
  EXPECT_EQ(said(core::InputError({"other.msh"}, "ours")), "other.msh: error: ours");
}

// Requirement: elements other than first-order tets are refused with their count and type.
TEST(ReadGmsh, refuses_other_elements) {
  std::string const hexahedra = replaced(block_geo, "Surface{1}; }", "Surface{1}; Layers{2}; Recombine; }");
  expect_part(refusal_of("hex.geo", hexahedra), "elements of type");
  expect_part(refusal_of("second.geo", block_geo + "Mesh.ElementOrder = 2;\n"), "Tetrahedron 10");
}

// Requirement: an element in two physical volumes is refused, since a tet has one material.
TEST(ReadGmsh, refuses_overlapping_volumes) {
  expect_part(refusal_of("two.geo", block_geo + "Physical Volume(\"both\") = {e[1], f[1]};\n"),
              "physical volumes 'both', 'lower'");
}

// Requirement: a physical name without elements is found as an empty group by the check.
TEST(ReadGmsh, keeps_empty_names) {
  Written const file("a.msh",
                     replaced(two_tets_2_2, "$PhysicalNames\n4", "$PhysicalNames\n5\n2 12 \"empty face\""));
  try {
    check_mesh(read_gmsh(file.path, 1, 0));
    FAIL();
  } catch (core::InputError const& error) {
    EXPECT_EQ(error.diagnostics.at(0).message, "surface group 'empty face' is empty");
  }
}

// Requirement: faults in a .geo are reported with gmsh's reason and line; a .geo must not end the program.
TEST(ReadGmsh, refuses_bad_geometry) {
  std::string const unknown = refusal_of("a.geo", "Point(1) = {0, 0, 0};\nLine(1) = {1, abc};\n");
  expect_part(unknown, "2: ");
  expect_part(unknown, "Unknown variable 'abc'");
  expect_part(refusal_of("a.geo", "Point(1) = {0, 0, 0};\n"), "no volume");
  expect_part(refusal_of("a.geo", "// Exit\nx = 1; /* Exit\n */ Exit;\n"),
              "3: statement 'Exit' is not allowed");
  expect_part(refusal_of("a.geo", "SystemCall \"ls\";\n"), "1: statement 'SystemCall' is not allowed");
  for (char const* statement : {"Save \"a.msh\"", "Print \"a.png\"", "Merge \"b.geo\"", "Include \"b.geo\"",
                                "OnelabRun(\"a\")", "CreateDir \"a\""})
    expect_part(refusal_of("a.geo", std::string("x = 1;\n") + statement + ";\n"), "2: statement '");
  expect_part(refusal_of("a.geo", "Printf(\"a\") > \"b\";\n"), "statement 'Printf > file' is not allowed");
  EXPECT_EQ(refusal_of("a.geo", "// SystemCall\nExitCode = 1;\nPrintf(\"Exit\");\n" + block_geo), "");
}

} // namespace
} // namespace fissura::mesh
