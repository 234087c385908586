// .inp files in parts, instances and an assembly: every name means one thing, and nothing is lost in silence.
#include <gtest/gtest.h>

#include <numeric>

#include <fmt/format.h>

#include "fissura/core/text.hpp"
#include "fissura/mesh/check.hpp"
#include "fissura/mesh/groups.hpp"
#include "fissura/mesh/inp_reader.hpp"
#include "support/refusal.hpp"

namespace fissura::mesh {
namespace {

Mesh read(std::string const& text, double unit = 1) {
  return parse_inp(text, "parts.inp", unit);
}
std::string refused(std::string const& text) {
  return support::refusal(core::Failure::input, [&] { read(text); });
}
std::string refused_name(Mesh const& m, int dimension, std::string const& name) {
  return support::refusal(core::Failure::input, [&] {
    groups_named(m, dimension, name, {"case.toml", 3, 1});
  });
}

/// Two tets on one triangle, with a set of nodes and one of elements that carry the same name.
std::string const block = R"(*Part, name=Block
*Node
1, 0, 0, 0
2, 10, 0, 0
3, 0, 10, 0
4, 0, 0, 10
5, 0, 0, -10
*Element, type=C3D4
1, 1, 2, 3, 4
2, 1, 2, 3, 5
*Nset, nset=Set-1, generate
1, 5, 1
*Elset, elset=Set-1, generate
1, 2, 1
*Elset, elset=Half
2
*Solid Section, elset=Set-1, material=C30
,
*End Part
)";
std::string const rod = R"(*Part, name=Rod
*Node
1, 0, 0, 0
2, 4, 0, 0
*Element, type=T3D2
1, 1, 2
*Elset, elset=Steel
1
*End Part
)";
std::string assembly(std::string const& text) {
  return "*Assembly, name=Whole\n" + text + "*End Assembly\n";
}
std::string instance(std::string const& name, std::string const& part, std::string const& position = "") {
  return fmt::format("*Instance, name={}, part={}\n{}*End Instance\n", name, part, position);
}

// Requirement: an instance is moved by its first line and turned by its second, about the axis given there,
// after it has been moved; the numbers are in the units of the file.
TEST(InpParts, instances_stand_where_they_are_put) {
  Mesh const m = read(block + rod +
                          assembly(instance("B", "Block") + instance("R1", "Rod", "1., 2., 3.\n") +
                                   instance("R2", "Rod", "1., 0., 0.\n0., 0., 0., 0., 0., 5., 90.\n") +
                                   instance("R3", "Rod", "0., 0., 0.\n0., 1., 0., 0., 1., 1., 30.\n")),
                      1e-3);
  auto const ends = [&](char const* name) {
    auto const s =
        m.line_groups.at(static_cast<std::size_t>(groups_named(m, 1, name, {}).at(0))).segments.at(0);
    return std::array{1e3 * m.points[static_cast<std::size_t>(s[0])],
                      1e3 * m.points[static_cast<std::size_t>(s[1])]};
  };
  auto const expect = [](Vec3 x, Vec3 wanted) {
    EXPECT_LT(norm(x - wanted), 1e-12) << x.x << ' ' << x.y << ' ' << x.z;
  };
  expect(ends("R1.Steel")[0], {1, 2, 3}), expect(ends("R1.Steel")[1], {5, 2, 3});
  expect(ends("R2.Steel")[0], {0, 1, 0}), expect(ends("R2.Steel")[1], {0, 5, 0});
  double const c = std::sqrt(0.75);
  expect(ends("R3.Steel")[0], {0.5, 1 - c, 0}), expect(ends("R3.Steel")[1], {0.5 + 4 * c, 1 - c + 2, 0});
  EXPECT_EQ(groups_named(m, 1, "Steel", {}).size(), 3u) << "the part's set in all its instances";
  EXPECT_EQ(groups_named(m, 1, "Rod.Steel", {}).size(), 3u);
  EXPECT_EQ(curve_named(m, "Steel", {}).segments.size(), 3u);
}

// Requirement: two instances of a part of tets are two bodies with numbers of their own, and their sets are
// called by instance, by part, or together.
TEST(InpParts, several_instances_of_one_part) {
  Mesh const m = read(block + assembly(instance("B1", "Block") + instance("B2", "Block", "100., 0., 0.\n")));
  EXPECT_NO_THROW(check_mesh(m));
  EXPECT_EQ(m.tets.size(), 4u);
  EXPECT_EQ(m.input_id, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(m.volume_groups, (std::vector<std::string>{"B1.Set-1", "B2.Set-1"}));
  EXPECT_EQ(m.tet_group, (std::vector<int>{0, 0, 1, 1}));
  EXPECT_EQ(groups_named(m, 3, "Set-1", {}), (std::vector<int>{0, 1}));
  EXPECT_EQ(tets_named(m, "B2.Half", {}), std::vector<int>{3});
  EXPECT_EQ(tets_named(m, "Half", {}), (std::vector<int>{1, 3}));
}

// Requirement: a set of a part and another one of the assembly with the same name are told apart by their
// long names, and the plain name is refused with both; where they are the same nodes it does not matter.
TEST(InpParts, one_name_in_two_scopes) {
  auto const with = [](char const* members) {
    return read(block + assembly(instance("B-1", "Block") + "*Nset, nset=Set-1, instance=B-1\n" + members));
  };
  Mesh const m = with("1, 4\n");
  auto const what = refused_name(m, 0, "Set-1");
  EXPECT_NE(
      what.find(
          "case.toml:3:1: error: the name 'Set-1' stands for several point groups of the mesh: write one of "
          "\"B-1.Set-1\", \"Whole.Set-1\""),
      std::string::npos)
      << what;
  auto const points = [&](char const* name) {
    return m.point_groups.at(static_cast<std::size_t>(groups_named(m, 0, name, {}).at(0))).points;
  };
  EXPECT_EQ(points("Whole.Set-1"), (std::vector<int>{0, 3}));
  EXPECT_EQ(points("B-1.Set-1"), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(groups_named(m, 3, "Set-1", {}), std::vector<int>{0}) << "one set of tets: nothing to tell apart";
  EXPECT_EQ(groups_named(with("1, 2, 3, 4, 5\n"), 0, "Set-1", {}).size(), 1u);
}

// Requirement: sets of two parts with one name are refused by it, and known by part or instance.
TEST(InpParts, one_name_in_two_parts) {
  std::string other = rod;
  other.replace(other.find("Rod"), 3, "Tie");
  Mesh const m = read(block + rod + other +
                      assembly(instance("B", "Block") + instance("R1", "Rod") + instance("R2", "Rod") +
                               instance("T1", "Tie")));
  EXPECT_NE(refused_name(m, 1, "Steel").find("write one of \"Rod.Steel\", \"T1.Steel\""), std::string::npos)
      << refused_name(m, 1, "Steel");
  EXPECT_EQ(groups_named(m, 1, "Rod.Steel", {}).size(), 2u);
  EXPECT_EQ(groups_named(m, 1, "T1.Steel", {}).size(), 1u);
}

// Requirement: the mesh may stand in the instance itself, with the part empty; an instance with sections or
// sets of its own still has the mesh of its part.
TEST(InpParts, mesh_inside_the_instance) {
  std::string const inner = block.substr(block.find("*Node"), block.find("*End Part") - block.find("*Node"));
  Mesh const whole = read(block + assembly(instance("B", "Block")));
  Mesh const own = read("*Part, name=Block\n*End Part\n" + assembly(instance("B", "Block", inner)));
  EXPECT_EQ(own.tets, whole.tets);
  EXPECT_EQ(own.points, whole.points);
  EXPECT_EQ(own.volume_groups, whole.volume_groups);
  Mesh const more = read(block + assembly(instance("B", "Block", "*Nset, nset=Tip\n4\n") +
                                          instance("C", "Block", "50., 0., 0.\n")));
  EXPECT_EQ(more.tets.size(), 4u);
  EXPECT_EQ(groups_named(more, 0, "Tip", {}).size(), 1u);
  EXPECT_EQ(groups_named(more, 3, "Set-1", {}).size(), 2u) << "both are instances of one part";
}

// Requirement: sets and surfaces of the assembly name members by instance, by prefix, by number, by the
// elements they belong to, or by the only instance that has them; without sides a surface is the outer faces
// of its tets.
TEST(InpParts, members_by_prefix) {
  Mesh const m =
      read(block + assembly(instance("B-1", "Block") + "*Nset, nset=Both\nB-1.Set-1\n"
                                                       "*Nset, nset=Two\nB-1.4, B-1.5\n"
                                                       "*Nset, nset=OfHalf, elset=B-1.Half\n"
                                                       "*Surface, type=ELEMENT, name=Side\nB-1.Half, S1\n"
                                                       "*Surface, type=ELEMENT, name=Outside\nHalf\n"
                                                       "*Surface, type=NODE, name=Nodes\nTwo, 1.\n"));
  auto const points = [&](char const* name) {
    return m.point_groups.at(static_cast<std::size_t>(groups_named(m, 0, name, {}).at(0))).points;
  };
  EXPECT_EQ(points("Both"), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(points("Two"), (std::vector<int>{3, 4}));
  EXPECT_EQ(points("OfHalf"), (std::vector<int>{0, 1, 2, 4}));
  EXPECT_EQ(points("Nodes"), points("Two"));
  auto const triangles = [&](char const* name) {
    return m.face_groups.at(static_cast<std::size_t>(groups_named(m, 2, name, {}).at(0))).triangles;
  };
  EXPECT_EQ(triangles("Side"), (std::vector<std::array<int, 3>>{{0, 1, 2}}));
  EXPECT_EQ(triangles("Outside").size(), 3u) << "the side to the other tet is inside";
}

// Requirement: elements that are no body, analytical surfaces, parts that nobody uses and keywords that the
// case has instead are named in the log; what would be missed is a warning.
TEST(InpParts, says_what_it_left_out) {
  Mesh const m = read(
      block + rod +
      assembly(instance("B", "Block") + "*Node\n1, 0, 0, 0\n*Element, type=MASS, elset=M\n1, 1\n" +
               "*Element, type=SPRINGA\n2, B.1, B.2\n3, B.1, B.3\n*Surface, type=CYLINDER, name=Roll\n") +
      "*Nset, nset=Late\n*Material, name=C30\n*Elastic\n30000., 0.2\n*Tie, name=T\na, "
      "b\n*Step\n*Static\n*End Step\n");
  auto const said = core::joined(m.notes, "\n");
  for (char const* what :
       {"left out, since they are no body: 1 element of type MASS, 2 elements of type SPRINGA",
        "left out: surface \"Roll\", not made of elements or nodes",
        "left out: parts without an *INSTANCE: \"Rod\"",
        "left out: sets and surfaces outside of parts and assembly: \"Late\"",
        "not read, since the case says it: *MATERIAL, *ELASTIC, *STEP, *STATIC"})
    EXPECT_NE(said.find(what), std::string::npos) << said;
  ASSERT_EQ(m.doubts.size(), 1u);
  EXPECT_NE(
      m.doubts[0].find("parts.inp:45: *TIE is not obeyed: bodies that it ties are joined here only where"),
      std::string::npos)
      << m.doubts[0];
}

// Requirement: letters behind the name of a shape are formulations of it; rigid shells are left out of their
// sets, and so are shells beside the tets.
TEST(InpParts, shapes_by_their_names) {
  std::string text = block;
  text.replace(text.find("C3D4"), 4, "C3D4H");
  text.replace(text.find("*Solid"), 0,
               "*Element, type=B31H, elset=Bar\n3, 1, 2, 5\n*Element, type=R3D3, elset=Rigid\n4, 1, 2, 3\n"
               "*Element, type=S3R, elset=Skin\n5, 1, 2, 4\n6, 1, 4, 5\n*Node, system=C, nset=Round\n11, 5., "
               "90., 1.\n");
  Mesh const m = read(text);
  EXPECT_EQ(m.tets.size(), 2u);
  EXPECT_EQ(m.line_groups.at(0).segments.size(), 1u) << "the third node of a beam gives its orientation";
  EXPECT_EQ(m.face_groups.at(0).triangles.size(), 1u);
  Vec3 const x = m.points.at(static_cast<std::size_t>(m.point_groups.at(1).points.at(0)));
  EXPECT_LT(norm(x - Vec3{0, 5, 1}), 1e-14);
  auto const said = core::joined(m.notes, "\n");
  for (char const* what :
       {"1 element of type R3D3", "1 three-node shells that are no faces of tets", "\"Rigid\""})
    EXPECT_NE(said.find(what), std::string::npos) << said;
}

// Requirement: what is wrong with parts and instances is refused at its line with the cure.
TEST(InpParts, refuses_with_the_line) {
  std::string const one = instance("B", "Block");
  for (auto const& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {block + rod, "parts.inp:20: error: parts without an *INSTANCE"},
           {block + assembly(""), "parts without an *INSTANCE"},
           {block + assembly(one + instance("B", "Block")),
            "parts.inp:23: error: instance \"B\" stands already in line 21"},
           {block + assembly(instance("B", "Block", "1., 2., 3., 4.\n")),
            "an *INSTANCE has a line with its translation"},
           {block + assembly(instance("B", "Block", "1.\n0., 0., 0., 0., 0., 0., 5.\n")),
            "the two points of the axis"},
           {block + assembly(one + "*Nset, nset=a, instance=C\n1\n"), "there is no instance \"C\" above"},
           {block + assembly(one + "*Nset, nset=a\nB.none\n"), "there is no node set \"none\" above"},
           {block + assembly(one + "*Elset, elset=a\nnone\n"), "there is no element set \"none\" above"},
           {block + assembly(one + instance("C", "Block") + "*Surface, name=s\nHalf\n"),
            "several instances have a set \"Half\": write \"B.Half\" or \"C.Half\""},
           {block + assembly(one + "*Elset, elset=e\nB.Half\n*Nset, nset=a, elset=e\n"),
            "*NSET, ELSET=... of a set of the assembly: write instance.set"},
           {block + assembly(one + "*Element, type=C3D4\n1, 1, 2, 3, 4\n"), "at the level of the assembly"},
           {block + assembly(one + instance("C", "Block") + "*Nset, nset=B.Set-1, instance=B\n1\n"),
            "\"B.Set-1\" names two sets of the file"}})
    EXPECT_NE(refused(text).find(expected), std::string::npos) << refused(text) << "\nexpected " << expected;
}

// Requirement: instances cannot make more than a bounded number of copies of a part.
TEST(InpParts, bounds_its_copies) {
  std::string many;
  for (int i = 0; i < 200; ++i)
    many += instance(fmt::format("B{}", i), "Block", fmt::format("{}., 0., 0.\n", 20 * i));
  auto const what =
      support::refusal(core::Failure::input, [&] { parse_inp(block + assembly(many), "f.inp", 1, 5000); });
  EXPECT_NE(what.find("instances make more than 5000 nodes, elements and members of sets"), std::string::npos)
      << what;
  EXPECT_EQ(read(block + assembly(many)).tets.size(), 400u);
}

} // namespace
} // namespace fissura::mesh
