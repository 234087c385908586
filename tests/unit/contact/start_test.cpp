#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "fissura/contact/contact.hpp"
#include "fissura/contact/facets.hpp"
#include "fissura/core/error.hpp"
#include "fissura/mesh/faces.hpp"
#include "fissura/mesh/gmsh_reader.hpp"
#include "support/concrete_model.hpp"

namespace fissura::contact {
namespace {

/// Two cubes of one mesh, the second one turned by 45 degrees and moved.
model::Model two_cubes(double gap) {
  mesh::Mesh m = support::box_mesh({1, 1, 1}, {0.1, 0.1, 0.1});
  mesh::Mesh const other = m;
  int const points = static_cast<int>(m.points.size());
  double const half_diagonal = 0.1 * std::sqrt(0.5);
  for (Vec3 const p : other.points) {
    double const x = p.x - 0.05, y = p.y - 0.05, r = std::sqrt(0.5);
    m.points.push_back({0.1 + gap + half_diagonal + r * (x - y), 0.05 + r * (x + y), p.z + 0.013});
  }
  for (auto tet : other.tets) {
    for (int& p : tet) p += points;
    m.tets.push_back(tet);
    m.tet_group.push_back(0);
    m.input_id.push_back(static_cast<int>(m.input_id.size()));
  }
  auto model = support::concrete_model(m);
  model.source.mesh.place = {"case.toml", 4, 1};
  return model;
}

// Requirement: an edge that touches a face at the start is fine, one that stands 5 mm in it is refused with
// the place in the deck, the tets and the coordinates; contact switched off asks nothing.
TEST(Start, refuses_bodies_that_stand_in_each_other) {
  EXPECT_NO_THROW(check_start(two_cubes(0)));
  EXPECT_NO_THROW(check_start(two_cubes(0.01)));
  auto deep = two_cubes(-0.005);
  try {
    check_start(deep);
    ADD_FAILURE() << "the overlap was accepted";
  } catch (core::InputError const& e) {
    EXPECT_EQ(e.diagnostics.at(0).place.line, 4);
    std::string const what = e.what();
    for (char const* word : {"overlap at the start", "tets ", "by up to 0.00", "at (0.09", "move them apart",
                             "initial_overlap = \"zero\""})
      EXPECT_NE(what.find(word), std::string::npos) << word << " in: " << what;
  }
  deep.source.contact.initial_overlap = model::InitialOverlap::zero;
  EXPECT_NE(check_start(deep).find("start from this overlap, without a force"), std::string::npos);
  EXPECT_EQ(check_start(two_cubes(0.01)), "");
  deep.source.contact.on = false;
  EXPECT_EQ(check_start(deep), "");
}

/// A pin in a hole of the same radius of 40 mm, each meshed by itself.
model::Model pin_in_its_hole() {
  std::string const file =
      (std::filesystem::temp_directory_path() / ("fissura_pin_" + std::to_string(::getpid()) + ".geo"))
          .string();
  std::ofstream(file) << R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 120, 120, 30};
Cylinder(2) = {60, 60, 0, 0, 0, 30, 40};
Cylinder(3) = {60, 60, 0, 0, 0, 30, 40};
BooleanDifference(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
MeshSize{ PointsOf{ Volume{4}; } } = 25;
MeshSize{ PointsOf{ Volume{3}; } } = 14;
)";
  auto const m = mesh::read_gmsh(file, 1e-3, 0);
  std::filesystem::remove(file);
  return support::concrete_model(m);
}

/// How far edges of the faces on the hole and the pin lie inside the circle of 40 mm [m].
double deepest_chord(mesh::Mesh const& m, mesh::Adjacency const& adjacency) {
  auto const radius = [](Vec3 p) { return std::hypot(p.x - 0.06, p.y - 0.06); };
  double deepest = 0;
  for (auto const f : adjacency.boundary) {
    auto const t = mesh::face_triangle(m, f);
    if (std::all_of(t.begin(), t.end(), [&](Vec3 p) { return std::abs(radius(p) - 0.04) < 1e-6; }))
      for (std::size_t k = 0; k < 3; ++k)
        deepest = std::max(deepest, 0.04 - radius(0.5 * (t[k] + t[(k + 1) % 3])));
  }
  return deepest;
}

// Requirement: where facets of curved faces cut into each other the refusal names their sagitta, which is the
// depth of their edges under the circle within a third, and the depth of the overlap.
TEST(Start, names_the_sagitta_of_facets) {
  auto const m = pin_in_its_hole();
  double const sagitta =
      largest_sagitta(m.mesh, m.adjacency, std::vector<char>(static_cast<std::size_t>(m.tet_count()), 1));
  double const depth = deepest_chord(m.mesh, m.adjacency);
  EXPECT_GT(depth, 2e-4);
  EXPECT_NEAR(sagitta, depth, depth / 3);
  try {
    check_start(m);
    ADD_FAILURE() << "the overlap was accepted";
  } catch (core::InputError const& e) {
    std::string const what = e.what();
    for (char const* word :
         {"by up to 0.00", "(the sagitta, edge^2/(8 radius))", "initial_overlap = \"zero\""})
      EXPECT_NE(what.find(word), std::string::npos) << word << " in: " << what;
  }
}

// Requirement: the way that nodes are taken to go until the next look, four steps ahead, twice, is at least
// what any two of them approach each other at their speeds, and at most root three times that; common motion
// does not count.
TEST(Search, foresees_how_near_nodes_can_come) {
  support::Random random(4);
  for (double const common : {0.0, 1000.0}) {
    auto m = two_cubes(0.05);
    m.source.contact.on = true;
    m.dt = 1e-7;
    auto s = support::concrete_state(m);
    state::Scratch w;
    w.overlay = state::Overlay(m.tets.blocks() * model::block, m.overlay_tets);
    int const nodes = support::node_count(m);
    for (int n = 0; n < nodes; ++n) support::set_node(s.v, n, random.vector(-5, 5) + Vec3{common, 0, 0});
    s.contact.is_due = 1;
    refresh_pairs(m, s, w);
    double fastest = 0;
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < a; ++b)
        fastest = std::max(fastest, norm(support::at_node(s.v, a) - support::at_node(s.v, b)));
    EXPECT_GE(2 * s.contact.travel, 4 * m.dt * fastest * (1 - 1e-12));
    EXPECT_LE(2 * s.contact.travel, 4 * m.dt * fastest * std::sqrt(3.0));
  }
}

} // namespace
} // namespace fissura::contact
