#include "fissura/sim/bench_scenes.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>

#include "fissura/concrete/concrete.hpp"
#include "fissura/core/error.hpp"

namespace fissura::sim {

using model::Case;
using model::Model;
using state::State;

namespace {

constexpr double cell = 0.05; // [m]

int scaled(double count) {
  return std::max(1, static_cast<int>(std::lround(count)));
}

Case block(std::array<int, 3> cells) {
  Case c;
  model::BoxSpec box;
  box.cells = cells;
  box.to = {cell * cells[0], cell * cells[1], cell * cells[2]};
  c.mesh.boxes = {box};
  model::ConcreteSpec concrete;
  concrete.name = "concrete";
  concrete.E = 30e9;
  concrete.f_t = 3e6;
  concrete.f_c = 30e6;
  c.concretes = {concrete};
  c.run.end_time = 1;
  c.run.joint_inertia = model::JointInertia::off;
  return c;
}

Case cube(long tets) {
  int const n = scaled(std::cbrt(static_cast<double>(tets) / 6));
  return block({n, n, n});
}

/// A cube meshed by gmsh: tets of all shapes, joints in no order.
Case unstructured_cube(long tets) {
  auto c = block({1, 1, 1});
  c.mesh.boxes.clear();
  // What gmsh makes of an element size on a cube, about.
  c.mesh.element_size = std::cbrt(5.8 / static_cast<double>(tets));
  auto const file = std::filesystem::temp_directory_path() / fmt::format("fissura_bench_{}.geo", ::getpid());
  std::ofstream(file) << "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n"
                      << "Physical Volume(\"concrete\") = {1};\n";
  c.mesh.file = file.string();
  return c;
}

model::BarSpec bar(std::string name, std::vector<Vec3> points, int count, Vec3 spacing) {
  model::BarSpec b;
  b.name = std::move(name);
  b.steel = "steel";
  b.diameter = 0.016;
  b.points = std::move(points);
  b.count = count;
  b.spacing = spacing;
  return b;
}

/// A beam with two bars below, two above and a stirrup every 10 cm.
Case beam(long tets) {
  double const a = std::cbrt(static_cast<double>(tets) / 288);
  std::array<int, 3> const cells{scaled(8 * a), scaled(2 * a), scaled(3 * a)};
  auto c = block(cells);
  c.contact.on = true;
  model::SteelSpec steel;
  steel.name = "steel";
  steel.E_s = 200e9;
  steel.f_y = 500e6;
  steel.f_u = 600e6;
  c.steels = {steel};
  Vec3 const to = c.mesh.boxes[0].to;
  double const in = 0.3 * cell, y = to.y - in, z = to.z - in, apart = to.y - 4 * in;
  for (double const height : {2 * in, to.z - 2 * in})
    c.bars.push_back(bar("long", {{in, 2 * in, height}, {to.x - in, 2 * in, height}}, 2, {0, apart, 0}));
  auto stirrup = bar("stirrup", {{in, in, in}, {in, y, in}, {in, y, z}, {in, in, z}}, scaled(to.x / 0.1 - 1),
                     {0.1, 0, 0});
  stirrup.closed = true;
  c.bars.push_back(stirrup);
  return c;
}

Case beam_with_inertia(long tets) {
  auto c = beam(tets);
  c.run.joint_inertia = model::JointInertia::on;
  return c;
}

/// Every node its own small velocity, so that nothing is trivially zero.
void shake(Model const& m, State& s) {
  for (int node = 0; node < 4 * m.tet_count(); ++node)
    for (int r = 0; r < 3; ++r) s.v(node, r) = 1e-6 * ((node * 7 + r * 3) % 11 - 5);
}

/// A number that looks random but is the same for the same joint.
bool is_every_second(int joint) {
  return (static_cast<unsigned>(joint) * 2654435761u) >> 31;
}

void damage_half(Model const& m, State& s) {
  shake(m, s);
  for (int j = 0; j < m.joint_count(); ++j)
    if (is_every_second(j)) concrete::set_damage(m, s, j, 0.2);
}

bool lies_in_plane(Model const& m, int joint, double spacing) {
  auto const& node = m.joints.joints[joint].node_a;
  for (int r = 0; r < 3; ++r) {
    double const first = m.position(node[0], r);
    bool lies = std::abs(first - spacing * std::round(first / spacing)) < 1e-3 * cell;
    for (int const n : node) lies = lies && std::abs(m.position(n, r) - first) < 1e-3 * cell;
    if (lies) return true;
  }
  return false;
}

/// Broken along planes, every fourth layer of cells: 10 % of the joints.
void break_to_pieces(Model const& m, State& s) {
  shake(m, s);
  for (int j = 0; j < m.joint_count(); ++j)
    if (lies_in_plane(m, j, 4 * cell)) concrete::set_damage(m, s, j, 1);
}

std::vector<BenchScene> const& scenes() {
  static std::vector<BenchScene> const all{
      {"uncracked", "uncracked cube", cube, shake},
      {"unstructured", "uncracked cube meshed by gmsh", unstructured_cube, shake},
      {"beam", "uncracked beam with bars and contact", beam, shake},
      {"joint_inertia", "the same beam with joint inertia", beam_with_inertia, shake},
      {"half_damaged", "cube, half of its joints damaged", cube, damage_half},
      {"fragmented", "cube in pieces, some 10 % of its joints broken, with contact", cube, break_to_pieces},
  };
  return all;
}

} // namespace

std::string bench_scene_names() {
  std::string names;
  for (auto const& s : scenes()) names += (names.empty() ? "" : ", ") + s.name;
  return names;
}

BenchScene const& bench_scene(std::string const& name) {
  for (auto const& s : scenes())
    if (s.name == name) return s;
  throw core::Error(core::Failure::input, "no scene '" + name + "'; there are " + bench_scene_names());
}

} // namespace fissura::sim
