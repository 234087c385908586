// A beam with a cage of 31 bars as an Abaqus deck of parts and instances, and the same beam written as a
// case.
#include <gtest/gtest.h>

#include <fstream>

#include <fmt/format.h>

#include "fissura/concrete/concrete.hpp"
#include "fissura/deck/deck.hpp"
#include "fissura/mesh/box.hpp"
#include "support/cases.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura {
namespace {

using output::testing::TemporaryFolder;

constexpr int stirrups = 25, pieces = 20; ///< stirrups 30 mm apart; elements of a bar
constexpr double first_stirrup = 41;      ///< [mm]

mesh::Mesh beam() {
  mesh::BoxCells box;
  box.name = "Concrete", box.to = {0.8, 0.12, 0.16}, box.cells = {10, 2, 2};
  return mesh::make_boxes(std::vector{box});
}

void write_concrete(std::ostream& out) {
  auto const m = beam();
  out << "*Part, name=Beam\n*Node\n";
  for (std::size_t i = 0; i < m.points.size(); ++i)
    out << fmt::format("{}, {}, {}, {}\n", i + 1, 1e3 * m.points[i].x, 1e3 * m.points[i].y,
                       1e3 * m.points[i].z);
  out << "*Element, type=C3D4H\n";
  for (std::size_t t = 0; t < m.tets.size(); ++t)
    out << fmt::format("{}, {}, {}, {}, {}\n", t + 1, m.tets[t][0] + 1, m.tets[t][1] + 1, m.tets[t][2] + 1,
                       m.tets[t][3] + 1);
  out << fmt::format("*Elset, elset=Concrete, generate\n1, {}, 1\n*Solid Section, elset=Concrete, "
                     "material=C30\n,\n*End Part\n",
                     m.tets.size());
}

/// Corners of a stirrup, and the places of the bars, in the section [mm].
constexpr std::array<std::array<double, 2>, 4> corners{{{21, 22}, {99, 22}, {99, 138}, {21, 138}}};
constexpr std::array<std::array<double, 2>, 6> places{
    {{31, 33}, {59, 33}, {89, 33}, {31, 127}, {59, 127}, {89, 127}}};

void write_inp(std::string const& path) {
  std::ofstream out(path);
  out << "*Heading\n";
  write_concrete(out);
  out << "*Part, name=Stirrup\n*Node\n";
  for (std::size_t k = 0; k < 4; ++k)
    out << fmt::format("{}, 0., {}, {}\n", k + 1, corners[k][0], corners[k][1]);
  out << "*Element, type=B31, elset=Hoop\n1, 1, 2\n2, 2, 3\n3, 3, 4\n4, 4, 1\n*End Part\n";
  // The bar is drawn along y, and turned when it is put in.
  out << "*Part, name=Bar\n*Node\n";
  for (int k = 0; k <= pieces; ++k) out << fmt::format("{}, 0., {}, 0.\n", k + 1, 38. * k);
  out << "*Element, type=T3D2, elset=Long\n";
  for (int k = 0; k < pieces; ++k) out << fmt::format("{}, {}, {}\n", k + 1, k + 1, k + 2);
  out << "*End Part\n*Assembly, name=Assembly\n*Instance, name=Beam-1, part=Beam\n*End Instance\n";
  for (int i = 0; i < stirrups; ++i)
    out << fmt::format("*Instance, name=Stirrup-{0}, part=Stirrup\n{1}, 0., 0.\n*End Instance\n", i + 1,
                       first_stirrup + 30 * i);
  for (std::size_t i = 0; i < places.size(); ++i) {
    double const y = places[i][0], z = places[i][1];
    out << fmt::format("*Instance, name=Bar-{0}, part=Bar\n20., {1}, {2}\n20., {1}, {2}, 20., {1}, {3}, "
                       "-90.\n*End Instance\n",
                       i + 1, y, z, z + 1);
  }
  out << "*Embedded Element, host elset=Beam-1.Concrete\nStirrup-1.Hoop\n*End Assembly\n*Material, "
         "name=C30\n";
}

std::string const mesh_from_file = "[mesh]\nfile = \"cage.inp\"\nlength_unit = \"mm\"\n";
std::string const mesh_of_boxes =
    "[[mesh.box]]\nname = \"Concrete\"\nto = [\"800 mm\", \"120 mm\", \"160 mm\"]\n"
    "from = [\"0 m\", \"0 m\", \"0 m\"]\ncells = [10, 2, 2]\n";
std::string const bars_from_file =
    "[[bar]]\nname = \"stirrups\"\nsteel = \"B500\"\ndiameter = \"6 mm\"\ncurve = \"Hoop\"\n"
    "[[bar]]\nname = \"bars\"\nsteel = \"B500\"\ndiameter = \"12 mm\"\ncurve = \"Long\"\n";

std::string bars_written() {
  std::string text =
      "[[bar]]\nname = \"stirrups\"\nsteel = \"B500\"\ndiameter = \"6 mm\"\nclosed = true\ncount = 25\n"
      "spacing = [\"30 mm\", \"0 mm\", \"0 mm\"]\npoints = [";
  for (auto const& c : corners)
    text += fmt::format("[\"{} mm\", \"{} mm\", \"{} mm\"], ", first_stirrup, c[0], c[1]);
  text += "]\n";
  for (std::size_t i = 0; i < places.size(); ++i) {
    text += fmt::format("[[bar]]\nname = \"bar_{}\"\nsteel = \"B500\"\ndiameter = \"12 mm\"\npoints = [", i);
    for (int k = 0; k <= pieces; ++k)
      text += fmt::format("[\"{} mm\", \"{} mm\", \"{} mm\"], ", 20 + 38 * k, places[i][0], places[i][1]);
    text += "]\n";
  }
  return text;
}

model::Case read(TemporaryFolder const& folder, std::string const& mesh, std::string const& bars) {
  return deck::read_case_text(mesh + bars + R"([[concrete]]
groups = ["Concrete"]
preset = "mc2010"
f_ck = "30 MPa"
[[steel]]
name = "B500"
f_y = "500 MPa"
f_u = "550 MPa"
[[support]]
where = {plane = "x", at = "0 m"}
fix = ["x", "y", "z"]
[[motion]]
name = "pull"
where = {plane = "x", at = "800 mm"}
axis = "z"
velocity = {value = "-3 m/s", over = "0.05 ms"}
[run]
end_time = "1 ms"
joint_inertia = false
threads = 1
)",
                              folder / "case.toml");
}

// Requirement: an Abaqus deck of a beam with 25 stirrups and 6 bars, drawn once each and put in by instances
// that move and turn them, has the tets, the bars, the steel and the step of the same beam written as a case,
// and moves as it to 1e-9 while cracks form.
TEST(CageInInstances, is_its_native_twin) {
  TemporaryFolder const folder;
  write_inp(folder / "cage.inp");
  support::Stepper inp(read(folder, mesh_from_file, bars_from_file));
  support::Stepper native(read(folder, mesh_of_boxes, bars_written()));
  int bars = 0;
  for (auto const& b : inp.report.embedding.bars) bars += b.copies;
  EXPECT_EQ(bars, 31);
  EXPECT_EQ(inp.m.tet_count(), native.m.tet_count());
  EXPECT_EQ(inp.m.bars.elements.size(), native.m.bars.elements.size());
  EXPECT_EQ(inp.m.bars.joints.size(), native.m.bars.joints.size());
  double const by_hand =
      7850 * 3.14159265358979 / 4 * (25 * 2 * (0.078 + 0.116) * 0.006 * 0.006 + 6 * 0.76 * 0.012 * 0.012);
  EXPECT_NEAR(inp.report.embedding.steel_mass(), by_hand, 1e-9 * by_hand);
  EXPECT_NEAR(native.report.embedding.steel_mass(), by_hand, 1e-9 * by_hand);
  EXPECT_NEAR(inp.m.total_mass, native.m.total_mass, 1e-12 * native.m.total_mass);
  EXPECT_NEAR(inp.m.dt, native.m.dt, 1e-9 * native.m.dt);
  native.m.dt = inp.m.dt;
  inp.advance(400), native.advance(400);
  EXPECT_GT(concrete::count_joints(inp.m, inp.s).damaged, 20);
  EXPECT_EQ(concrete::count_joints(inp.m, inp.s).damaged, concrete::count_joints(native.m, native.s).damaged);
  double largest = 0, difference = 0;
  for (int n = 0; n < support::node_count(inp.m); ++n) {
    largest = std::max(largest, norm(support::at_node(inp.s.u, n)));
    difference = std::max(difference, norm(support::at_node(inp.s.u, n) - support::at_node(native.s.u, n)));
  }
  EXPECT_GT(largest, 1e-5);
  EXPECT_LT(difference, 1e-9 * largest);
}

} // namespace
} // namespace fissura
