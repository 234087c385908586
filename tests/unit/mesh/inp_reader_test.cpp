#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "fissura/core/error.hpp"
#include "fissura/core/text.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/check.hpp"
#include "fissura/mesh/groups.hpp"
#include "fissura/mesh/inp_reader.hpp"

namespace fissura::mesh {
namespace {

/// A file that lives as long as its test.
class Written {
 public:
  explicit Written(std::string const& text)
      : path(std::filesystem::temp_directory_path() / ("fissura_" + std::to_string(getpid()) + ".inp")) {
    std::ofstream(path, std::ios::binary) << text;
  }
  ~Written() { std::filesystem::remove(path); }
  std::filesystem::path path;
};

Mesh read(std::string const& text, double unit = 1) {
  Written const file(text);
  return read_inp(file.path, unit);
}

std::string refusal(std::string const& text) {
  try {
    read(text);
  } catch (core::InputError const& e) {
    std::string const what = e.what();
    return what.substr(what.find(".inp"));
  }
  return "accepted";
}

/// Two tets on one triangle, the second turned inside out, a bar of two elements, sets of every kind.
std::string const two_tets = R"(*Heading
** a comment
 made by hand
*NODE, NSET=Nall
1, 0, 0, 0
2, 10.0, 0., 0.
3, 0, 1.0E+1, 0
  4, 0, 0, +10
5, 0, 0, -1.0D1
9, 77, 0, 0
*Element, type=C3D4, Elset=Volume1
21, 1, 2, 3, 4
22, 1, 2, 3,
 5
*ELEMENT, TYPE=T3D2, ELSET=bar
31, 1, 2
32, 2, 9
*ELSET, ELSET=concrete
21
*ELSET, ELSET=rest
22
*ELSET, ELSET=all_bars
bar
*NSET, NSET="Tip"
4
*NSET, NSET=some, GENERATE
1, 9, 2
*SURFACE, NAME=top, TYPE=ELEMENT
concrete, S3
22, S2
*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*STEP
*BOUNDARY
Nall, 1, 3
*END STEP
)";

std::string with(std::string const& old_text, std::string const& new_text) {
  std::string text = two_tets;
  auto const at = text.find(old_text);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, old_text.size(), new_text);
}

// Requirement: nodes come in metres, tets turn positive with the numbers of the file, and sets become groups
// of their kind with the names of the file; all else is left alone.
TEST(ReadInp, elements_and_sets) {
  Mesh const m = read(two_tets, 1e-3);
  EXPECT_NO_THROW(check_mesh(m));
  ASSERT_EQ(m.points.size(), 6u);
  EXPECT_NEAR(m.points[2].y, 0.01, 1e-17);
  EXPECT_NEAR(m.points[4].z, -0.01, 1e-17);
  ASSERT_EQ(m.tets.size(), 2u);
  for (int t = 0; t < 2; ++t) EXPECT_NEAR(geometry::volume(corners(m, t)), 1e-6 / 6, 1e-18);
  EXPECT_EQ(m.input_id, (std::vector<int>{21, 22}));
  EXPECT_EQ(m.volume_groups, (std::vector<std::string>{"concrete", "rest"}))
      << "*ELSET before the element line";
  EXPECT_EQ(m.tet_group, (std::vector<int>{0, 1}));
  ASSERT_EQ(m.line_groups.size(), 2u);
  EXPECT_EQ(m.line_groups[0].name, "bar");
  EXPECT_EQ(m.line_groups[0].segments, (std::vector<std::array<int, 2>>{{0, 1}, {1, 5}}));
  EXPECT_EQ(m.line_groups[1].name, "all_bars");
  EXPECT_EQ(m.line_groups[1].segments, m.line_groups[0].segments);
  ASSERT_EQ(m.point_groups.size(), 3u);
  EXPECT_EQ(m.point_groups[1].name, "Tip");
  EXPECT_EQ(m.point_groups[1].points, std::vector<int>{3});
  EXPECT_EQ(m.point_groups[2].points, (std::vector<int>{0, 2, 4, 5})) << "every second number that exists";
  ASSERT_EQ(m.face_groups.size(), 1u);
  EXPECT_EQ(m.face_groups[0].triangles, (std::vector<std::array<int, 3>>{{1, 3, 2}, {0, 4, 1}}));
}

/// The names that other names of a dimension stand for, in one line.
std::string meaning(Mesh const& m, int dimension, std::string const& name) {
  for (auto const& alias : m.aliases)
    if (alias.dimension == dimension && alias.name == name)
      return (alias.is_ambiguous ? "one of " : "") + core::joined(alias.groups, " ");
  return "";
}

// Requirement: *SOLID SECTION decides which set is the material of a tet that is in several; a set that
// others make up is one more name of theirs, one across them stays a set, and without sections sets that
// overlap are refused.
TEST(ReadInp, sections_decide) {
  std::string const all =
      with("*NSET, NSET=\"Tip\"", "*ELSET, ELSET=Eall, GENERATE\n21, 22\n*NSET, NSET=\"Tip\"");
  Mesh const both = read(all);
  EXPECT_EQ(both.volume_groups, (std::vector<std::string>{"concrete", "rest"}));
  EXPECT_EQ(meaning(both, 3, "Eall"), "concrete rest");
  EXPECT_EQ(meaning(both, 3, "Volume1"), "concrete rest");
  Mesh const m = read(
      all + "*SOLID SECTION, ELSET=eall, MATERIAL=C30\n*SOLID SECTION, ELSET=bar, MATERIAL=B500\n0.0002\n");
  EXPECT_EQ(m.volume_groups, std::vector<std::string>{"Eall"});
  ASSERT_EQ(m.tet_sets.size(), 2u) << "concrete and rest";
  EXPECT_EQ(m.tet_sets[1].name, "rest");
  EXPECT_EQ(m.tet_sets[1].tets, std::vector<int>{1});
  EXPECT_EQ(tets_named(m, "volume:rest", {}), std::vector<int>{1});
  EXPECT_EQ(tets_named(m, "Volume1", {}), (std::vector<int>{0, 1}));
  Mesh const part = read(two_tets + "*SOLID SECTION, ELSET=rest, MATERIAL=C30\n");
  EXPECT_EQ(part.volume_groups, (std::vector<std::string>{"rest", "default"}));
  EXPECT_EQ(part.tet_group, (std::vector<int>{1, 0}));
  std::string const overlapping =
      two_tets + "*NODE\n6, 10, 10, 10\n*ELEMENT, TYPE=C3D4\n23, 2, 3, 4, 6\n*ELSET, ELSET=pair\n22, 23\n";
  EXPECT_NE(refusal(overlapping)
                .find(".inp:13: error: tet 22 is in the element sets \"rest\" and \"pair\": a tet has one "
                      "material; name the sets of the materials in *SOLID SECTION"),
            std::string::npos)
      << refusal(overlapping);
}

// Requirement: one part, with an instance in an assembly or without an assembly, is the same mesh as the flat
// file; reference points of the assembly are left out, and the log says so.
TEST(ReadInp, one_part) {
  std::string const part =
      "*PART, NAME=P\n" +
      two_tets.substr(two_tets.find("*NODE"), two_tets.find("*NSET, NSET=\"Tip\"") - two_tets.find("*NODE")) +
      "*END PART\n";
  std::string const assembly =
      "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*NODE\n1, 5, 5, 5\n"
      "*NSET, NSET=rp\n1\n*NSET, NSET=Tip, INSTANCE=I\n4\n*END ASSEMBLY\n";
  for (auto const& text : {part, part + assembly}) {
    Mesh const m = read(text);
    EXPECT_EQ(m.tets, read(two_tets).tets);
    EXPECT_EQ(m.points, read(two_tets).points);
    EXPECT_EQ(m.volume_groups, read(two_tets).volume_groups);
  }
  Mesh const m = read(part + assembly);
  ASSERT_EQ(m.point_groups.size(), 2u);
  EXPECT_EQ(m.point_groups[1].points, std::vector<int>{3});
  EXPECT_EQ(meaning(m, 0, "A.Tip"), "Tip");
  EXPECT_EQ(meaning(m, 3, "I.concrete"), "concrete");
  ASSERT_EQ(m.notes.size(), 1u);
  EXPECT_NE(
      m.notes[0].find("sets that hold nothing of the mesh (reference points, elements left out): \"rp\""),
      std::string::npos);
}

// Requirement: each fault is refused at its line with what was expected.
TEST(ReadInp, refuses_with_the_line) {
  struct Fault {
    std::string old_text, new_text, expected;
  };
  for (auto const& f : std::vector<Fault>{
           {"type=C3D4", "type=C3D10", ".inp:11: error: elements of type C3D10: only C3D4 (tetrahedra)"},
           {", type=C3D4", "", ".inp:11: error: *ELEMENT without TYPE"},
           {"22, 1, 2, 3,\n 5", "22, 1, 2, 3", ".inp:13: error: an element of 4 nodes has 5 numbers, not 4"},
           {"21, 1, 2, 3, 4", "21, 1, 2, 3, 7",
            ".inp:12: error: element 21 names node 7, which is not in the file"},
           {"31, 1, 2", "21, 1, 2", ".inp:16: error: element 21 stands already in line 12"},
           {"3, 0, 1.0E+1, 0", "2, 0, 10, 0", ".inp:7: error: node 2 stands already in line 6"},
           {"3, 0, 1.0E+1, 0", "3, 0, nan, 0", ".inp:7: error: \"nan\" where a coordinate is expected"},
           {"3, 0, 1.0E+1, 0", "3, 0, 1e999, 0", ".inp:7: error: \"1e999\" where a coordinate is expected"},
           {"3, 0, 1.0E+1, 0", "99999999999, 0, 1, 0", "where a number from 1 is expected"},
           {"3, 0, 1.0E+1, 0", "3, 0, 1, 0, 4, 5", "a node has a number and three coordinates, not 6 values"},
           {"\nbar\n*NSET", "\nbars\n*NSET", ".inp:23: error: there is no element set \"bars\" above"},
           {"\nbar\n*NSET", "\nall_bars\n*NSET", "there is no element set \"all_bars\" above"},
           {"*ELSET, ELSET=rest\n22", "*ELSET, ELSET=rest\n23", "there is no element 23"},
           {"22, S2", "22, S5", "a line of a *SURFACE is an element or a set of them, and a side"},
           {"22, S2", "bar, S2", "element 31 has no side S2: it is no tet"},
           {"*Heading", "*INCLUDE, INPUT=other.inp",
            ".inp:1: error: *INCLUDE is not known: all nodes and elements must stand in the file itself"},
           {"*Heading", "*IMPERFECTION, STEP=1", ".inp:1: error: *IMPERFECTION is not known: it moves nodes"},
           {"*Heading", "*SYSTEM\n1., 0., 0.", ".inp:2: error: *SYSTEM is not known: write the nodes in"},
           {"*NODE, NSET=Nall", "*NODE, SYSTEM=S", "only rectangular and cylindrical coordinates"},
           {"*NODE, NSET=Nall", "*NODE, INPUT=nodes.txt",
            ".inp:4: error: *NODE, INPUT: all nodes and elements"},
           {"*MATERIAL, NAME=STEEL", "*PART, NAME=a\n*END PART",
            ".inp:5: error: nodes or elements outside of every *PART, in a file with parts"},
           {"*MATERIAL, NAME=STEEL", "*PART", "*PART needs a name"},
           {"*MATERIAL, NAME=STEEL", "*ASSEMBLY\n*PART, NAME=a", "*PART inside *ASSEMBLY"},
           {"*MATERIAL, NAME=STEEL", "*PART, NAME=a\n*PART, NAME=A", "part \"A\" stands already in line 31"},
           {"*MATERIAL, NAME=STEEL", "*INSTANCE, NAME=a", "*INSTANCE needs a name and a part"},
           {"*MATERIAL, NAME=STEEL", "*INSTANCE, NAME=a, PART=b", "there is no part \"b\" above"},
           {"*MATERIAL, NAME=STEEL", "*INSTANCE, LIBRARY=old",
            "*INSTANCE, LIBRARY: its mesh stands in the results"},
           {"*MATERIAL, NAME=STEEL", "*NSET, NSET=n, INSTANCE=I",
            "only sets of the assembly name an instance"},
           {"type=C3D4", "type=C3D8R", "elements of type C3D8R: only C3D4 (tetrahedra)"},
           {"TYPE=T3D2", "TYPE=B32", "elements of type B32: only C3D4 (tetrahedra), T3D2 or B31 (bars)"},
           {"ELSET=rest\n", "ELSET=some_tets\n22\n*SURFACE, NAME=top\n22, S4\n*ELSET, ELSET=rest\n",
            "\"top\" is also the name of another set or surface, in line"},
           {"GENERATE\n1, 9, 2", "GENERATE\n1", "GENERATE expects: first, last, step"},
           {"GENERATE\n1, 9, 2", "GENERATE\n1, 9, 0", "where a number from 1 is expected"},
           {"NSET=\"Tip\"", "NSET=", "*NSET needs a name"},
       })
    EXPECT_NE(refusal(with(f.old_text, f.new_text)).find(f.expected), std::string::npos)
        << refusal(with(f.old_text, f.new_text)) << "\nexpected " << f.expected;
  EXPECT_NE(refusal("*NODE\n1, 0, 0, 0\n").find("the file has no tets"), std::string::npos);
  EXPECT_NE(refusal("").find("cannot be read (is it empty"), std::string::npos);
  EXPECT_NE(refusal(with("*STEP", "*SOLID SECTION, ELSET=wood, MATERIAL=STEEL\n*STEP"))
                .find("*SOLID SECTION: there is no element set \"wood\""),
            std::string::npos);
}

// Requirement: a length unit that is none is refused, whatever the file holds.
TEST(ReadInp, refuses_a_length_unit_of_zero) {
  try {
    read(two_tets, 0);
    ADD_FAILURE() << "accepted";
  } catch (core::InputError const& e) {
    EXPECT_NE(std::string(e.what()).find("length unit 0 m: it must be positive"), std::string::npos)
        << e.what();
  }
}

// Requirement: sets that name others many times over are refused before they fill the memory: some millions
// of members are allowed in any file, more in one that is large itself.
TEST(ReadInp, bounds_its_sets) {
  std::string text = two_tets + "*NODE\n";
  for (int i = 100; i < 10100; ++i) text += std::to_string(i) + ", 0, 0, 0\n";
  text += "*NSET, NSET=s0, GENERATE\n100, 10099\n";
  std::string one_set = text + "*NSET, NSET=s1\n", ranges = text, many_sets = text;
  for (int i = 0; i < 190; ++i) one_set += "s0\n";
  EXPECT_EQ(refusal(one_set), "accepted");
  for (int i = 0; i < 100; ++i) one_set += "s0\n";
  for (int i = 0; i < 300; ++i) ranges += "*NSET, NSET=r" + std::to_string(i) + ", GENERATE\n1, 20000\n";
  std::string const too_many = "more members of sets than a file of this size describes";
  EXPECT_NE(refusal(one_set).find(too_many), std::string::npos);
  EXPECT_NE(refusal(ranges).find(too_many), std::string::npos);
  for (int i = 0; i < 100001; ++i) many_sets += "*NSET, NSET=m" + std::to_string(i) + "\n";
  EXPECT_NE(refusal(many_sets).find("more than 100000 sets"), std::string::npos);
}

// Requirement: short lines by the hundred thousand and lines without end are refused before they fill the
// memory with many times the size of the file.
TEST(ReadInp, bounds_its_lines) {
  auto const repeated = [](char const* head, char const* line, int times) {
    std::string text = two_tets + head;
    for (int i = 0; i < times; ++i) text += line;
    return text;
  };
  auto const expect = [](std::string const& text, char const* expected) {
    std::string const what = refusal(text);
    EXPECT_NE(what.find(expected), std::string::npos) << what << " instead of " << expected;
  };
  expect(repeated("*NODE\n", "7\n", 600000), "more nodes than a file of this size describes");
  expect(repeated("*ELEMENT, TYPE=T3D2\n", "7,1,2\n", 1100000), "more elements than");
  expect(repeated("*NSET, NSET=a\n", "1,3\n", 700000), "more entries of sets than");
  expect(repeated("", "*SURFACE, NAME=a\n", 100001), "more than 100000 surfaces");
  expect(two_tets + "*NSET, NSET=a\n" + std::string(70000, '1'), "a line of more than 65536 characters");
}

// Requirement: a comma at the end of a node or of a list of members is no reason to go on in the next line;
// an element goes on.
TEST(ReadInp, commas_at_the_end) {
  Mesh const m =
      read("*NODE\n1, 0, 0,\n2, 1, 0,\n3, 0, 1,\n4, 0, 0, 1\n*ELEMENT, TYPE=C3D4\n1, 1, 2,\n3,\n4\n"
           "*NSET, NSET=a\n1, 2,\n4,\n");
  EXPECT_EQ(m.points.size(), 4u);
  EXPECT_EQ(m.tets.size(), 1u);
  ASSERT_EQ(m.point_groups.size(), 1u);
  EXPECT_EQ(m.point_groups[0].points.size(), 3u);
}

// Requirement: whatever bytes are changed, the reader ends with a mesh or an input error.
TEST(ReadInp, survives_changed_bytes) {
  std::mt19937 random(7);
  std::string const letters = "*,=0123456789-+.eE\n\"CSND";
  for (int i = 0; i < 3000; ++i) {
    std::string text = two_tets;
    for (int k = 0; k < 1 + i % 5; ++k) text[random() % text.size()] = letters[random() % letters.size()];
    if (i % 7 == 0) text.resize(random() % text.size());
    refusal(text); // anything but an input error ends the test
  }
}

// Requirement: an .inp file that is not there, a folder in its place, and one that is larger than any mesh
// are refused in words.
TEST(ReadInp, refuses_what_is_no_file) {
  auto const folder =
      std::filesystem::temp_directory_path() / ("fissura-folder-" + std::to_string(::getpid()) + ".inp");
  auto const refusal_of_path = [&] {
    try {
      read_inp(folder, 1);
    } catch (core::InputError const& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal_of_path().find("no such mesh file"), std::string::npos);
  std::filesystem::create_directory(folder);
  EXPECT_NE(refusal_of_path().find("the mesh file is not a regular file"), std::string::npos);
  std::filesystem::remove(folder);
  std::ofstream(folder) << "*NODE\n";
  std::filesystem::resize_file(folder, (std::uintmax_t{2} << 30U) + 1); // takes no room on the disk
  EXPECT_NE(refusal_of_path().find("the mesh file is larger than 2 GiB"), std::string::npos);
  std::filesystem::remove(folder);
}

} // namespace
} // namespace fissura::mesh
