// Fragments: which tets hang together, what they weigh and how they move.
#include "fissura/sim/fragments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fissura/concrete/concrete.hpp"
#include "fissura/output/json.hpp"
#include "support/cases.hpp"

namespace fissura::support {
namespace {

using state::JointStatus;

void set_status(Stepper& x, int joint, JointStatus status) {
  x.s.joint_status[joint] = static_cast<std::uint8_t>(status);
}
/// Breaks all joints that lie across the plane x = at.
void break_plane(Stepper& x, double at) {
  for (int j = 0; j < x.m.joint_count(); ++j) {
    bool across = true;
    for (int const node : x.m.joints.joints[j].node_a) across &= std::abs(position(x.m, node).x - at) < 1e-9;
    if (across) set_status(x, j, JointStatus::broken);
  }
}
double mass_error(Stepper const& x, sim::Fragments const& f) {
  return std::abs(f.mass() / x.m.total_mass - 1);
}

// Requirement: joints that are intact or damaged hold a body together, broken and released ones do not.
TEST(Fragments, part_where_joints_are_broken) {
  Stepper x(box_case({3, 1, 1}, {0.3, 0.1, 0.1}, 1));
  EXPECT_EQ(sim::find_fragments(x.m, x.s).bodies.size(), 1u);
  for (int j = 0; j < x.m.joint_count(); ++j) set_status(x, j, JointStatus::damaged);
  EXPECT_EQ(sim::find_fragments(x.m, x.s).bodies.size(), 1u);
  break_plane(x, 0.1);
  auto const f = sim::find_fragments(x.m, x.s);
  ASSERT_EQ(f.bodies.size(), 2u);
  EXPECT_EQ(f.bodies[0].tets, 12);
  EXPECT_EQ(f.bodies[1].tets, 6);
  EXPECT_NEAR(f.bodies[0].mass, 2500 * 0.002, 1e-12);
  EXPECT_NEAR(f.bodies[0].centroid.x, 0.2, 1e-12);
  EXPECT_NEAR(f.bodies[1].centroid.x, 0.05, 1e-12);
  for (int t = 0; t < x.m.tet_count(); ++t) {
    auto const corner = mesh::corners(x.m.mesh, t);
    double const middle = (corner[0].x + corner[1].x + corner[2].x + corner[3].x) / 4;
    EXPECT_EQ(f.of_tet[t], middle > 0.1 ? 0 : 1);
  }
  for (int j = 0; j < x.m.joint_count(); ++j) set_status(x, j, JointStatus::released);
  EXPECT_EQ(sim::find_fragments(x.m, x.s).bodies.size(), 18u);
}

// Requirement: tets bonded without joints are one body whatever happens to the joints around them.
TEST(Fragments, bonded_tets_are_one_body) {
  auto c = box_case({1, 1, 1}, {0.1, 0.1, 0.1}, 1);
  c.mesh.boxes.push_back(box_of_cells("plate", {0.1, 0, 0}, {0.2, 0.1, 0.1}, {1, 1, 1}));
  c.concretes.push_back(c.concretes[0]);
  c.concretes[0].groups = {"concrete"};
  c.concretes[1].groups = {"plate"}, c.concretes[1].joints = false;
  Stepper x(c);
  for (int j = 0; j < x.m.joint_count(); ++j) set_status(x, j, JointStatus::broken);
  auto const f = sim::find_fragments(x.m, x.s);
  ASSERT_EQ(f.bodies.size(), 7u);
  EXPECT_EQ(f.bodies[0].tets, 6);
  EXPECT_NEAR(f.bodies[0].centroid.x, 0.15, 1e-12);
}

// Requirement: the masses of the fragments, steel included and mass scaling not, add up to the mass of the
// model to 1e-12 however the body breaks; momentum and kinetic energy add up to those of the model.
TEST(Fragments, add_up_to_the_model) {
  auto c = tie_case({12, 5, 5}, 1, 1);
  c.concretes[0].density_factor = 3;
  c.run.joint_inertia = model::JointInertia::off;
  Stepper x(c);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int n = 0; n < node_count(x.m); ++n)
    for (int r = 0; r < 3; ++r) x.s.v(n, r) = number(random);
  for (double const share : {0.0, 0.3, 0.7, 0.9, 1.0}) {
    for (int j = 0; j < x.m.joint_count(); ++j)
      set_status(x, j, (number(random) + 1) / 2 < share ? JointStatus::broken : JointStatus::intact);
    auto const f = sim::find_fragments(x.m, x.s);
    EXPECT_LT(mass_error(x, f), 1e-12);
    double kinetic = 0, kinetic_of_nodes = 0, tets = 0;
    Vec3 momentum, momentum_of_nodes;
    for (auto const& b : f.bodies) {
      kinetic += b.kinetic_energy;
      momentum += 3 * b.mass * b.velocity; // mass scaling
      tets += b.tets;
    }
    for (int n = 0; n < node_count(x.m); ++n) {
      Vec3 const v = at_node(x.s.v, n);
      kinetic_of_nodes += x.m.mass[n] * dot(v, v) / 2;
      momentum_of_nodes += x.m.mass[n] * v;
    }
    EXPECT_EQ(tets, x.m.tet_count());
    EXPECT_NEAR(kinetic, kinetic_of_nodes, 1e-10 * kinetic_of_nodes);
    EXPECT_LT(norm(momentum - momentum_of_nodes), 1e-10 * norm(momentum_of_nodes));
    for (std::size_t i = 1; i < f.bodies.size(); ++i) EXPECT_GE(f.bodies[i - 1].mass, f.bodies[i].mass);
  }
}

// Requirement: the masses of 48,000 equal tets, each a fragment, add up to 1e-12.
TEST(Fragments, many_masses_add_up) {
  Stepper x(box_case({20, 20, 20}, {0.1, 0.1, 0.1}, 1));
  for (int j = 0; j < x.m.joint_count(); ++j) set_status(x, j, JointStatus::broken);
  auto const f = sim::find_fragments(x.m, x.s);
  EXPECT_EQ(f.bodies.size(), 48000u);
  EXPECT_LT(mass_error(x, f), 1e-12);
}

// Requirement: equal masses are numbered by the smallest input number of their tets.
TEST(Fragments, ties_are_numbered_by_input) {
  Stepper x(box_case({2, 1, 1}, {0.25, 0.125, 0.125}, 1)); // lengths without rounding
  for (int j = 0; j < x.m.joint_count(); ++j) set_status(x, j, JointStatus::broken);
  auto const f = sim::find_fragments(x.m, x.s);
  ASSERT_EQ(f.bodies.size(), 12u);
  for (std::size_t i = 0; i < f.bodies.size(); ++i)
    EXPECT_EQ(f.bodies[i].first_id, static_cast<int>(i) + f.bodies[0].first_id);
  for (int t = 0; t < x.m.tet_count(); ++t) EXPECT_EQ(f.bodies[f.of_tet[t]].first_id, x.m.mesh.input_id[t]);
}

// Requirement: a bar does not join bodies, but both ends of it are said to be held until it ruptures.
TEST(Fragments, say_when_a_bar_holds_them) {
  Stepper x(tie_case({4, 3, 3}, 1, 1));
  break_plane(x, 0.15);
  auto const f = sim::find_fragments(x.m, x.s);
  ASSERT_EQ(f.bodies.size(), 2u);
  EXPECT_TRUE(f.bodies[0].held_by_bars && f.bodies[1].held_by_bars);
  for (auto& h : x.s.bars.history) h.ruptured = true;
  auto const torn = sim::find_fragments(x.m, x.s);
  EXPECT_FALSE(torn.bodies[0].held_by_bars || torn.bodies[1].held_by_bars);
}

// Requirement: run.json lists the 20 largest fragments and counts all.
TEST(Fragments, largest_are_listed) {
  Stepper x(box_case({2, 2, 2}, {0.2, 0.2, 0.2}, 1));
  for (int j = 0; j < x.m.joint_count(); ++j) set_status(x, j, JointStatus::broken);
  auto const j = sim::fragments_json(sim::find_fragments(x.m, x.s));
  EXPECT_EQ(j["count"], 48);
  EXPECT_EQ(j["largest"].size(), 20u);
  EXPECT_NEAR(j["mass"].get<double>(), 2500 * 0.008, 1e-12);
  for (char const* key : {"mass", "tets", "centroid", "velocity", "kinetic_energy", "held_by_bars"})
    EXPECT_TRUE(j["largest"][0].contains(key)) << key;
}

// Requirement: the count is taken anew when the number of broken joints changes.
TEST(FragmentCount, follows_the_broken_joints) {
  Stepper x(box_case({3, 1, 1}, {0.3, 0.1, 0.1}, 1));
  sim::FragmentCount count;
  EXPECT_EQ(count(x.m, x.s, 0), 1);
  break_plane(x, 0.1);
  EXPECT_EQ(count(x.m, x.s, concrete::count_joints(x.m, x.s).broken), 2);
}

} // namespace
} // namespace fissura::support
