// A mesh that comes as .inp and as .msh is the same problem; a cage weighs what one works out by hand.
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fissura/deck/deck.hpp"
#include "fissura/mesh/box.hpp"
#include "fissura/sim/build_model.hpp"
#include "fissura/sim/run.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura {
namespace {

using output::testing::TemporaryFolder;

/// A prism of 300 x 100 x 100 mm with points along its axis.
mesh::Mesh prism() {
  mesh::BoxCells box;
  box.name = "concrete", box.to = {0.3, 0.1, 0.1}, box.cells = {6, 2, 2};
  return mesh::make_boxes(std::vector{box});
}

/// Points on the axis, from left to right (numbered from 1).
std::vector<std::size_t> axis_of(mesh::Mesh const& m) {
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t i = 0; i < m.points.size(); ++i)
    if (std::abs(m.points[i].y - 0.05) < 1e-9 && std::abs(m.points[i].z - 0.05) < 1e-9)
      found.emplace_back(m.points[i].x, i + 1);
  std::sort(found.begin(), found.end());
  std::vector<std::size_t> ids;
  for (auto const& f : found) ids.push_back(f.second);
  return ids;
}

void write_inp(mesh::Mesh const& m, std::string const& path) {
  std::ofstream out(path);
  out << "*NODE\n";
  for (std::size_t i = 0; i < m.points.size(); ++i)
    out << fmt::format("{}, {}, {}, {}\n", i + 1, 1e3 * m.points[i].x, 1e3 * m.points[i].y,
                       1e3 * m.points[i].z);
  out << "*ELEMENT, TYPE=C3D4, ELSET=concrete\n";
  for (std::size_t t = 0; t < m.tets.size(); ++t)
    out << fmt::format("{}, {}, {}, {}, {}\n", t + 1, m.tets[t][0] + 1, m.tets[t][1] + 1, m.tets[t][2] + 1,
                       m.tets[t][3] + 1);
  out << "*ELEMENT, TYPE=T3D2, ELSET=rebar\n";
  auto const axis = axis_of(m);
  for (std::size_t i = 1; i < axis.size(); ++i)
    out << fmt::format("{}, {}, {}\n", m.tets.size() + i, axis[i - 1], axis[i]);
}

void write_msh(mesh::Mesh const& m, std::string const& path) {
  auto const axis = axis_of(m);
  std::ofstream out(path);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 2 \"rebar\"\n3 1 "
         "\"concrete\"\n$EndPhysicalNames\n";
  out << "$Nodes\n" << m.points.size() << "\n";
  for (std::size_t i = 0; i < m.points.size(); ++i)
    out << fmt::format("{} {} {} {}\n", i + 1, 1e3 * m.points[i].x, 1e3 * m.points[i].y, 1e3 * m.points[i].z);
  out << "$EndNodes\n$Elements\n" << m.tets.size() + axis.size() - 1 << "\n";
  for (std::size_t t = 0; t < m.tets.size(); ++t)
    out << fmt::format("{} 4 2 1 1 {} {} {} {}\n", t + 1, m.tets[t][0] + 1, m.tets[t][1] + 1,
                       m.tets[t][2] + 1, m.tets[t][3] + 1);
  for (std::size_t i = 1; i < axis.size(); ++i)
    out << fmt::format("{} 1 2 2 2 {} {}\n", m.tets.size() + i, axis[i - 1], axis[i]);
  out << "$EndElements\n";
}

nlohmann::json run_with_mesh(TemporaryFolder const& folder, std::string const& file) {
  std::string const deck = fmt::format(R"([mesh]
file = "{}"
length_unit = "mm"
[[concrete]]
groups = ["concrete"]
preset = "mc2010"
f_c = "38 MPa"
[[steel]]
name = "B500"
f_y = "500 MPa"
f_u = "550 MPa"
[[bar]]
steel = "B500"
diameter = "12 mm"
curve = "rebar"
[[support]]
where = {{plane = "x", at = "0 m"}}
fix = ["x", "y", "z"]
[[motion]]
name = "pull"
where = {{plane = "x", at = "300 mm"}}
axis = "x"
velocity = {{value = "1 m/s", over = "0.1 ms"}}
[run]
end_time = "0.4 ms"
threads = 1
)",
                                       file);
  sim::RunOptions options;
  options.quiet = true;
  sim::Run run(deck::read_case_text(deck, folder / "case.toml"), options);
  run.open();
  while (run.step()) {
  }
  run.finish();
  return nlohmann::json::parse(run.summary());
}

// Requirement: an .inp mesh with C3D4 and T3D2 elements gives the same response, to the last bit, as the same
// mesh from gmsh.
TEST(InpMesh, runs_as_its_gmsh_twin) {
  TemporaryFolder const folder;
  auto const m = prism();
  write_inp(m, folder / "prism.inp");
  write_msh(m, folder / "prism.msh");
  auto const inp = run_with_mesh(folder, "prism.inp"), msh = run_with_mesh(folder, "prism.msh");
  EXPECT_EQ(inp["status"], "complete");
  EXPECT_GT(inp["bar_joints"], 0);
  EXPECT_GT(inp["joints_damaged"], 0);
  EXPECT_EQ(inp["state_hash"], msh["state_hash"]);
  EXPECT_EQ(inp["energy"], msh["energy"]);
}

model::Case cage_case(std::string const& to) {
  return deck::read_case_text(R"([[mesh.box]]
from = ["0 m", "0 m", "0 m"]
to = ["3 m", "200 mm", "300 mm"]
cells = [30, 4, 6]
[[concrete]]
preset = "mc2010"
f_ck = "30 MPa"
[[steel]]
name = "B500"
f_y = "500 MPa"
f_u = "550 MPa"
[[cage]]
steel = "B500"
from = ["0 m", "0 m", "0 m"]
to = )" + to + R"(
cover = "25 mm"
bottom = ["3 x 16 mm", "2 x 12 mm"]
top = "2 x 10 mm"
sides = "1 x 8 mm"
stirrups = "8 mm / 150 mm"
[run]
end_time = "1 ms"
)",
                              "case.toml");
}

// Requirement: the steel of a cage weighs what one works out by hand, to 1e-9 of it, after it has been cut by
// the mesh.
TEST(Cage, has_the_mass_worked_out_by_hand) {
  sim::BuildReport report;
  auto const m = sim::build_model(cage_case(R"(["3 m", "200 mm", "300 mm"])"), report);
  // longitudinal bars: 3 m less two covers; stirrups: 200 and 300 mm less two covers and one diameter, 20 of
  // them
  double const bars =
      (3 - 2 * 0.025) * (3 * 0.016 * 0.016 + 2 * 0.012 * 0.012 + 2 * 0.010 * 0.010 + 2 * 0.008 * 0.008);
  double const stirrups = 20 * 2 * ((0.2 - 0.05 - 0.008) + (0.3 - 0.05 - 0.008)) * 0.008 * 0.008;
  double const by_hand = 7850 * std::numbers::pi / 4 * (bars + stirrups);
  EXPECT_NEAR(report.embedding.steel_mass(), by_hand, 1e-9 * by_hand);
  double of_elements = 0;
  for (auto const& e : m.bars.elements) {
    auto const& p = m.bars.properties[static_cast<std::size_t>(e.bar)];
    of_elements += p.area * e.length * p.steel.density;
  }
  EXPECT_NEAR(of_elements, by_hand, 1e-9 * by_hand);
}

// Requirement: a cage that leaves the concrete is refused by the name of its bar, at the cage.
TEST(Cage, outside_the_concrete_is_refused) {
  sim::BuildReport report;
  try {
    sim::build_model(cage_case(R"(["3 m", "200 mm", "400 mm"])"), report);
    FAIL() << "accepted";
  } catch (core::InputError const& e) {
    std::string const what = e.what();
    EXPECT_NE(what.find("case.toml:12:1"), std::string::npos) << what;
    EXPECT_NE(what.find("cage_1_top"), std::string::npos) << what;
  }
}

} // namespace
} // namespace fissura
