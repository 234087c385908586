// A .geo gives the model that the files give which gmsh saves of it.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <gmsh.h>

#include "fissura/deck/deck.hpp"
#include "fissura/model/select.hpp"
#include "fissura/sim/build_model.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura {
namespace {

using output::testing::TemporaryFolder;

struct Geometry {
  char const* name;
  char const* text;
  char const* deck; ///< concrete and bars
  std::vector<char const*> groups;
};

char const* const box = "SetFactory(\"OpenCASCADE\");\nMesh.MeshSizeMin = 60; Mesh.MeshSizeMax = 60;\n"
                        "Box(1) = {0, 0, 0, 200, 80, 80};\n";
char const* const all_tets = "[[concrete]]\nE = \"33 GPa\"\nf_t = \"2.9 MPa\"\nf_c = \"38 MPa\"\n";
char const* const two_groups =
    "[[concrete]]\ngroups = [\"PhysicalVolume1\"]\nE = \"33 GPa\"\nf_t = \"2.9 MPa\"\nf_c = \"38 MPa\"\n"
    "[[concrete]]\ngroups = [\"PhysicalVolume2\"]\nE = \"20 GPa\"\nf_t = \"2 MPa\"\nf_c = \"30 MPa\"\n";
char const* const bars = "[[steel]]\nname = \"B500\"\nf_y = \"500 MPa\"\nf_u = \"550 MPa\"\n"
                         "[[bar]]\nsteel = \"B500\"\ndiameter = \"12 mm\"\ncurve = \"rebar\"\n";

std::vector<Geometry> geometries() {
  static std::string const reinforced = std::string(all_tets) + bars;
  return {
      {"a box with groups of every dimension",
       "Physical Volume(\"concrete\") = {1};\nPhysical Surface(\"end\") = {1};\nPhysical Curve(\"edge\") = "
       "{1};\n",
       all_tets,
       {"concrete", "end", "edge"}},
      {"two volumes, one of them in no group",
       "Box(2) = {200, 0, 0, 200, 80, 80};\nCoherence;\nPhysical Volume(\"concrete\") = {1};\n",
       all_tets,
       {"concrete"}},
      {"a scaling factor, and volumes in no group that are saved all the same",
       "Box(2) = {200, 0, 0, 200, 80, 80};\nCoherence;\nMesh.ScalingFactor = 0.5;\nMesh.SaveAll = 1;\n"
       "Physical Volume(\"concrete\") = {1};\n",
       all_tets,
       {"concrete"}},
      {"four bars in one physical curve",
       "For i In {0:3}\n p = newp; Point(p) = {10, 20 + 40*(i%2), 20 + 40*Floor(i/2), 60}; Point(p+1) = "
       "{190, 20 + 40*(i%2), "
       "20 + 40*Floor(i/2), 60};\n l~{i} = newl; Line(l~{i}) = {p, p+1};\nEndFor\n"
       "Physical Volume(\"concrete\") = {1};\nPhysical Curve(\"rebar\") = {l_0, l_1, l_2, l_3};\n",
       reinforced.c_str(),
       {"concrete"}},
      {"numbers instead of names, the same for surfaces and volumes",
       "Box(2) = {200, 0, 0, 200, 80, 80};\nCoherence;\nMesh.SaveGroupsOfNodes = 1;\n"
       "Physical Surface(1) = {-1};\nPhysical Volume(1) = {1};\nPhysical Volume(2) = {2};\n",
       two_groups,
       {"PhysicalSurface1", "PhysicalVolume2"}},
      {"a notch, and no group at all",
       "Box(2) = {90, 0, 0, 20, 80, 40};\nBooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n",
       all_tets,
       {}},
  };
}

/// Saves what gmsh makes of a .geo, as `gmsh -3 -save` does.
void save(std::string const& geo, std::string const& to, double version, double binary) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::open(geo);
  gmsh::model::mesh::generate(3);
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::option::setNumber("Mesh.Binary", binary);
  gmsh::write(to);
  gmsh::finalize();
}

struct Model {
  model::Model m;
  sim::BuildReport report;
};
Model build(TemporaryFolder const& folder, std::string const& file, char const* deck) {
  Model made;
  std::string const text =
      fmt::format("{}[mesh]\nfile = \"{}\"\nlength_unit = \"mm\"\n[run]\nend_time = \"1 ms\"\n", deck, file);
  made.m = sim::build_model(deck::read_case_text(text, folder / "case.toml"), made.report);
  return made;
}

Vec3 sum_of_points(mesh::Mesh const& m, std::string const& group, std::size_t& count) {
  model::Selector s;
  s.kind = model::Selector::Kind::group, s.group = group;
  Vec3 sum;
  auto const points = model::select_points(m, s);
  count = points.size();
  for (int const p : points) sum += m.points[static_cast<std::size_t>(p)];
  return sum;
}

void expect_equal(Model const& a, Model const& b, Geometry const& geometry) {
  EXPECT_EQ(a.m.tet_count(), b.m.tet_count());
  EXPECT_NEAR(a.m.total_mass, b.m.total_mass, 1e-12 * a.m.total_mass);
  EXPECT_NEAR(a.m.dt, b.m.dt, 1e-9 * a.m.dt);
  EXPECT_EQ(a.m.bars.elements.size(), b.m.bars.elements.size());
  EXPECT_NEAR(a.report.embedding.steel_mass(), b.report.embedding.steel_mass(), 1e-12);
  EXPECT_EQ(a.m.material_of_tet, b.m.material_of_tet);
  for (char const* group : geometry.groups) {
    std::size_t of_a = 0, of_b = 0;
    Vec3 const difference = sum_of_points(a.m.mesh, group, of_a) - sum_of_points(b.m.mesh, group, of_b);
    EXPECT_EQ(of_a, of_b) << group;
    EXPECT_LT(norm(difference), 1e-12) << group;
  }
}

// Requirement: a .geo and the files that gmsh saves of it (.msh 2.2 and 4.1 as text and bytes, .inp) are one
// model: as many tets, the same mass and materials to 1e-12, groups of the same nodes, as many bar elements
// of the same mass, and the same step to 1e-9.
TEST(MeshTwins, a_geometry_is_what_gmsh_saves) {
  for (auto const& geometry : geometries()) {
    SCOPED_TRACE(geometry.name);
    TemporaryFolder const folder;
    std::ofstream(folder / "g.geo") << box << geometry.text;
    auto const from_geo = build(folder, "g.geo", geometry.deck);
    struct Saved {
      char const* file;
      double version, binary;
    };
    for (auto const& s : {Saved{"t22.msh", 2.2, 0},
                          {"b22.msh", 2.2, 1},
                          {"t41.msh", 4.1, 0},
                          {"b41.msh", 4.1, 1},
                          {"g.inp", 4.1, 0}}) {
      SCOPED_TRACE(s.file);
      save(folder / "g.geo", folder / s.file, s.version, s.binary);
      bool const saves_all = std::string(geometry.text).find("SaveAll") != std::string::npos;
      if (saves_all && s.version < 4) { // gmsh writes every element without its group
        EXPECT_THROW(build(folder, s.file, geometry.deck), core::InputError);
        continue;
      }
      expect_equal(from_geo, build(folder, s.file, geometry.deck), geometry);
    }
  }
}

// Requirement: the masses are those of the volumes that gmsh saves, and what is left out is said.
TEST(MeshTwins, masses_worked_out_by_hand) {
  auto const all = geometries();
  double const one = 0.2 * 0.08 * 0.08 * 2500;
  std::map<std::size_t, double> const mass{
      {0, one}, {1, one}, {2, 2 * one / 8}, {4, 2 * one}, {5, one - 0.02 * 0.08 * 0.04 * 2500}};
  for (auto const& [i, expected] : mass) {
    TemporaryFolder const folder;
    std::ofstream(folder / "g.geo") << box << all[i].text;
    auto const made = build(folder, "g.geo", all[i].deck);
    EXPECT_NEAR(made.m.total_mass, expected, 1e-9 * expected) << all[i].name;
    bool const says =
        !made.report.warnings.empty() &&
        made.report.warnings[0].find("left out, as gmsh does when it saves: volume 2 (") != std::string::npos;
    EXPECT_EQ(says, i == 1) << all[i].name;
  }
}

// Requirement: a geometry with groups but none of volumes is refused as its .msh would be; so is a scaling of
// zero.
TEST(MeshTwins, refuses_what_gmsh_would_not_save) {
  auto const refusal = [](char const* text) {
    TemporaryFolder const folder;
    std::ofstream(folder / "g.geo") << box << text;
    try {
      build(folder, "g.geo", all_tets);
    } catch (core::InputError const& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(refusal("Physical Surface(\"end\") = {1};\n")
                .find("none of its volumes is in one: gmsh saves no tets of it"),
            std::string::npos);
  EXPECT_NE(refusal("Mesh.ScalingFactor = 0;\n").find("Mesh.ScalingFactor = 0: it must not be zero"),
            std::string::npos);
}

} // namespace
} // namespace fissura
