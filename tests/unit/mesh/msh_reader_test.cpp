// The reader of .msh files: it agrees with gmsh's own, in all four kinds of file, and refuses what lies.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <gmsh.h>

#include "fissura/core/error.hpp"
#include "fissura/mesh/gmsh_reader.hpp"
#include "fissura/mesh/msh_reader.hpp"

namespace fissura::mesh {
namespace {

/// Two stacked blocks with named and unnamed groups of every dimension, one surface in two of them.
std::string const geometry = R"(
Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5}; Point(3) = {1, 1, 0, 0.5}; Point(4) = {0, 1, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
e[] = Extrude {0, 0, 1} { Surface{1}; };
f[] = Extrude {0, 0, 1} { Surface{e[0]}; };
Physical Volume("upper") = {f[1]}; Physical Volume("lower") = {e[1]};
Physical Surface("bottom") = {1}; Physical Surface(70) = {f[0]}; Physical Surface("both ends") = {f[0], 1};
Physical Curve("edge") = {1, 3}; Physical Point("tip") = {1};
)";

std::string bytes_of(std::filesystem::path const& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The geometry as gmsh meshes it, and the files it writes of that mesh.
class Files : public testing::Test {
 protected:
  Files() {
    std::filesystem::create_directory(folder);
    std::ofstream(folder / "block.geo") << geometry;
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::open((folder / "block.geo").string());
    gmsh::model::mesh::generate(3);
    for (double const version : {2.2, 4.1})
      for (int const binary : {0, 1}) {
        gmsh::option::setNumber("Mesh.MshFileVersion", version);
        gmsh::option::setNumber("Mesh.Binary", binary);
        auto const name = std::string(version > 3 ? "4" : "2") + (binary ? "b" : "t") + ".msh";
        gmsh::write((folder / name).string());
      }
    gmsh::finalize();
  }
  ~Files() override { std::filesystem::remove_all(folder); }
  std::filesystem::path const folder =
      std::filesystem::temp_directory_path() / ("fissura_msh_" + std::to_string(::getpid()));
};

template <class Group, class Content> auto sorted(std::vector<Group> const& groups, Content const& content) {
  std::vector<std::pair<std::string, std::size_t>> out;
  for (auto const& g : groups) out.emplace_back(g.name, content(g).size());
  std::sort(out.begin(), out.end());
  return out;
}

// Requirement: the same mesh comes from a geometry through gmsh and from the files gmsh writes of it, as text
// and as bytes: the same points, tets and groups in the same order. (Format 2.2 writes a face that lies in
// two groups once for each of them, and has no other way to say so.)
TEST_F(Files, give_the_mesh_that_gmsh_gives) {
  Mesh const wanted = read_gmsh(folder / "block.geo", 1e-3, 0);
  for (char const* name : {"4t.msh", "4b.msh", "2t.msh", "2b.msh"}) {
    Mesh const m = read_gmsh(folder / name, 1e-3, 0);
    ASSERT_EQ(m.points.size(), wanted.points.size()) << name;
    for (std::size_t i = 0; i < m.points.size(); ++i) EXPECT_LT(norm(m.points[i] - wanted.points[i]), 1e-17);
    EXPECT_EQ(m.tets, wanted.tets) << name;
    EXPECT_EQ(m.tet_group, wanted.tet_group) << name;
    EXPECT_EQ(m.volume_groups, wanted.volume_groups) << name;
    auto const triangles = [](auto const& g) { return g.triangles; };
    EXPECT_EQ(sorted(m.face_groups, triangles), sorted(wanted.face_groups, triangles)) << name;
    auto const segments = [](auto const& g) { return g.segments; };
    EXPECT_EQ(sorted(m.line_groups, segments), sorted(wanted.line_groups, segments)) << name;
    auto const points = [](auto const& g) { return g.points; };
    EXPECT_EQ(sorted(m.point_groups, points), sorted(wanted.point_groups, points)) << name;
    if (name[0] == '4') {
      EXPECT_EQ(m.input_id, wanted.input_id) << name;
    }
  }
}

// Requirement: a file that is cut short anywhere is refused, or gives a mesh (when only its tail is missing);
// one with a few bytes changed likewise. Nothing else happens, whatever the bytes are.
TEST_F(Files, survive_any_damage) {
  std::mt19937 random(7);
  int refused = 0, read = 0;
  for (char const* name : {"4t.msh", "4b.msh", "2t.msh", "2b.msh"}) {
    auto const whole = bytes_of(folder / name);
    auto const attempt = [&](std::string const& text) {
      try {
        parse_msh(text, "a.msh", 1);
        ++read;
      } catch (core::InputError const&) {
        ++refused;
      }
    };
    for (int i = 0; i < 300; ++i) attempt(whole.substr(0, random() % whole.size()));
    for (int i = 0; i < 700; ++i) {
      auto text = whole;
      for (unsigned k = 0; k <= random() % 4; ++k) text[random() % text.size()] = static_cast<char>(random());
      attempt(text);
    }
  }
  EXPECT_EQ(read + refused, 4000);
  EXPECT_GT(refused, 1000);
  EXPECT_GT(read, 100);
}

std::string const head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
std::string const one_tet = "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
                            "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

std::string refusal(std::string const& text) {
  try {
    parse_msh(text, "a.msh", 1);
  } catch (core::InputError const& e) {
    return e.what();
  }
  return "";
}
std::string changed(std::string text, std::string const& what, std::string const& with) {
  auto const at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

struct Lie {
  std::string what, with, message;
};

// Requirement: every count is checked against the size of the file before room is made for it, and every
// number against what it may be; the message says what was expected, at the line.
TEST(Msh, refuses_what_cannot_be) {
  std::string const good = head + one_tet;
  EXPECT_EQ(refusal(good), "");
  EXPECT_NE(refusal(head).find("the mesh has no tets"), std::string::npos);
  Lie const lies[] = {
      {"4.1 0", "3.0 0", "mesh format 3: only the formats 2.2 and 4.1 are read"},
      {"4.1 0 8", "4.1 2 8", "file type 2: it is 0 (text) or 1 (binary)"},
      {"4.1 0 8", "4.1 0 4", "numbers of 4 bytes: only 8 are read"},
      {"4.1 0 8", "x 0 8", "expected the version of the format (a number), found 'x'"},
      {"4.1 0 8\n", "4.1 1 8 ", "expected the end of the line before the bytes"},
      {"$EndMeshFormat", "$EndNodes", "expected $EndMeshFormat, found '$EndNodes'"},
      {"$Nodes\n1", "$Nodes\n99999999999", "the number of blocks of nodes = 99999999999, but there are only"},
      {"$Nodes\n1 4", "$Nodes\n1 99999999999", "the number of nodes = 99999999999, but there are only"},
      {"$Nodes\n1 4", "$Nodes\n1 -4", "the number of nodes = -4 is negative"},
      {"$Nodes\n1 4", "$Nodes\n1 3", "the blocks hold more nodes than the 3 announced"},
      {"$Nodes\n1 4", "$Nodes\n1 5", "the blocks hold 4 of the 5 nodes announced"},
      {"3 1 0 4", "4 1 0 4", "an entity of dimension 4"},
      {"3 1 0 4", "3 9999999999 0 4", "the tag of an entity = 9999999999 is too large"},
      {"0 0 1\n", "0 0 nan\n", "a coordinate of a node is not finite"},
      {"0 0 1\n", "0 0 1e999\n", "expected a coordinate of a node (a number), found '1e999'"},
      {"0 0 1\n", "0 0 1x\n", "expected a coordinate of a node (a number), found '1x'"},
      {"1 1 2 3 4", "1 1 2 3 9", "an element names node 9, which is not in the mesh"},
      {"3 1 4 1", "3 1 5 1", "elements of type 'Hexahedron 8': only first-order tetrahedra"},
      {"3 1 4 1", "3 1 77 1", "elements of type 77: only first-order tetrahedra"},
      {"1 1 1 1\n3", "1 2 1 1\n3", "the blocks hold 1 of the 2 elements announced"},
      {"1 1 1 1\n3", "1 0 1 1\n3", "the blocks hold more elements than the 0 announced"},
      {"$Nodes", "Nodes", "expected the name of a section ($Nodes, $Elements, ...), found 'Nodes'"},
      {"$Nodes", "$PartitionedEntities", "this mesh is cut into partitions"},
      {"$Nodes", "$Periodic\n", "the section $Periodic has no end"},
      {"$Elements", one_tet.substr(0, 70) + "$Elements", "a second section $Nodes"},
      {"$Nodes", "$PhysicalNames\n1\n5 1 \"a\"\n$EndPhysicalNames\n$Nodes", "a group of dimension 5"},
      {"$Nodes", "$PhysicalNames\n1\n3 1 a\n$EndPhysicalNames\n$Nodes",
       "expected the name of a group in quotes"},
      {"$MeshFormat", "$Meshes\n$EndMeshes\n$MeshFormat", "it does not begin with $MeshFormat"},
      {"$MeshFormat", "MeshFormat", "it does not begin with $MeshFormat"},
  };
  for (auto const& lie : lies)
    EXPECT_NE(refusal(changed(good, lie.what, lie.with)).find(lie.message), std::string::npos)
        << lie.message << "\n  is not in\n"
        << refusal(changed(good, lie.what, lie.with));
  EXPECT_NE(refusal(changed(good, "1 1 2 3 4", "1 1 2 3 9")).find("a.msh:19: error"), std::string::npos);
  EXPECT_NE(refusal("$Comments\n$EndComments\n").find("has no section $MeshFormat"), std::string::npos);
}

// Requirement: the same for what only format 2.2 and files of bytes can say.
TEST(Msh, refuses_what_cannot_be_in_2_2) {
  std::string const good =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
      "$EndNodes\n$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n";
  EXPECT_EQ(refusal(good), "");
  Lie const lies[] = {
      {"4\n1 0 0 0", "4\n-1 0 0 0", "the tag -1 of a node is negative"},
      {"$Nodes\n4", "$Nodes\n4000", "the number of nodes = 4000, but there are only"},
      {"1 4 2 0", "1 4 2000 0", "an element with 2000 tags"},
      {"$Elements\n1", "$Elements\n-1", "the number of elements = -1, but"},
  };
  for (auto const& lie : lies)
    EXPECT_NE(refusal(changed(good, lie.what, lie.with)).find(lie.message), std::string::npos)
        << lie.message << "\n  is not in\n"
        << refusal(changed(good, lie.what, lie.with));

  std::string bytes = "$MeshFormat\n2.2 1 8\n";
  EXPECT_NE(refusal(bytes).find("the file ends where the order of bytes should be"), std::string::npos);
  EXPECT_NE(refusal(bytes + std::string("\0\0\0\1", 4)).find("in another order (big-endian)"),
            std::string::npos);
  bytes += std::string("\1\0\0\0\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n2\n", 51);
  EXPECT_NE(refusal(bytes + std::string("\4\0\0\0\7\0\0\0\0\0\0\0", 12))
                .find("the number of elements of a type = 7, but there are only 4 bytes left"),
            std::string::npos)
      << refusal(bytes + std::string("\4\0\0\0\7\0\0\0\0\0\0\0", 12));
}

// Requirement: more entities, or more groups, than any mesh has are refused before there is room for them.
TEST(Msh, bounds_entities_and_groups) {
  EXPECT_NE(refusal(head + "$Entities\n500001 0 0 0\n" + std::string(8 * 500001, ' '))
                .find("a.msh:5: error: more than 500000 entities"),
            std::string::npos);
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
                     "$EndNodes\n$Elements\n100001\n";
  for (int i = 1; i <= 100001; ++i) {
    auto const n = std::to_string(i);
    text += n + " 4 2 " + n + ' ' + n + " 1 2 3 4\n";
  }
  EXPECT_NE(refusal(text + "$EndElements\n").find("error: more than 100000 groups"), std::string::npos)
      << refusal(text + "$EndElements\n");
}

// Requirement: an element in more groups than a file of its size can name is refused before memory runs out.
TEST(Msh, bounds_overlapping_groups) {
  std::string text = head + "$Entities\n0 0 1 0\n1 0 0 0 1 1 1 3000";
  for (int i = 1; i <= 3000; ++i) text += " " + std::to_string(i);
  text += " 0\n$EndEntities\n$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n$Elements\n1 "
          "9 1 9\n2 1 2 9\n";
  for (int i = 1; i <= 9; ++i) text += std::to_string(i) + " 1 2 3\n";
  EXPECT_NE(refusal(text + "$EndElements\n").find("in too many groups"), std::string::npos);
}

} // namespace
} // namespace fissura::mesh
