// What joints put on the nodes: equal and opposite forces, on both sides of every face.
#include <gtest/gtest.h>

#include "support/corner_forces.hpp"

namespace fissura::support {
namespace {

struct Shaken {
  model::Model m;
  state::State s;
  state::Scratch w;
  core::NodeField f;

  /// Random displacements of every node up to `size` [m].
  Shaken(model::ConcreteSpec const& concrete, double size)
      : m(concrete_model(random_box_mesh(11, {3, 2, 2}, {0.3, 0.2, 0.2}), concrete)), s(concrete_state(m)),
        w(concrete_scratch(m)) {
    m.dt = 1e-7;
    Random random(3);
    for (int n = 0; n < node_count(m); ++n) set_node(s.u, n, random.vector(-size, size));
    concrete::joint_forces(m, s, w);
    corner_forces(m, s, w, 0, f);
  }
  /// The joints' part alone: all forces less those of the same tets without joint forces.
  core::NodeField joint_part() {
    auto const empty = concrete_scratch(m);
    core::NodeField tets, rest(f.nodes());
    corner_forces(m, s, empty, 0, tets);
    for (std::size_t i = 0; i < f.values.size(); ++i) rest.values[i] = f.values[i] - tets.values[i];
    return rest;
  }
};

void expect_balance(Shaken& x, double moment_tolerance) {
  auto const f = x.joint_part();
  Vec3 sum, moment;
  double size = 0, moments = 0;
  for (int n = 0; n < node_count(x.m); ++n) {
    Vec3 const force = at_node(f, n), at = position(x.m, n) + at_node(x.s.u, n);
    sum += force;
    moment += cross(at, force);
    size += norm(force);
    moments += norm(cross(at, force));
  }
  EXPECT_GT(size, 0);
  EXPECT_LE(norm(sum), 1e-12 * size);
  EXPECT_LE(norm(moment), moment_tolerance * moments);
}

// Requirement: joint forces sum to zero to 1e-12; their moment vanishes but for force times opening.
TEST(JointBalance, intact_joints) {
  Shaken x(plain_concrete(), 1e-7);
  EXPECT_EQ(concrete::count_joints(x.m, x.s).damaged, 0);
  expect_balance(x, 1e-6);
}

// Requirement: damaged and broken joints balance their moments too, to rounding.
TEST(JointBalance, damaged_joints) {
  Shaken x(plain_concrete(), 1e-4);
  auto const n = concrete::count_joints(x.m, x.s);
  EXPECT_GT(n.damaged, x.m.joint_count() / 2);
  EXPECT_GT(n.broken, 0);
  expect_balance(x, 1e-12);
}

// Requirement: the force on each node of a joint is the sum of traction times area/6 over its two mid-edges:
// a joint opened evenly pulls its faces together with sigma A, shared equally.
TEST(JointBalance, an_evenly_opened_joint_carries_stress_times_area) {
  auto const concrete = plain_concrete();
  auto m = concrete_model(box_mesh({2, 1, 1}, {0.2, 0.1, 0.1}), concrete);
  auto s = concrete_state(m);
  auto w = concrete_scratch(m);
  double const opening = 1e-7; // half of o_p or less
  set_field(m, s.u, [](Vec3) { return Vec3{}; });
  for (int t = 0; t < m.tet_count(); ++t) {
    auto const x = mesh::corners(m.mesh, t);
    if (0.25 * (x[0].x + x[1].x + x[2].x + x[3].x) < 0.1) continue;
    for (int c = 0; c < 4; ++c) set_node(s.u, model::node_of(t, c), {opening, 0, 0});
  }
  concrete::joint_forces(m, s, w);
  int opened = 0;
  for (int j = 0; j < m.joint_count(); ++j) {
    auto const& joint = m.joints.joints[j];
    bool const at_middle = std::abs(position(m, joint.node_a[0]).x - 0.1) < 1e-9 &&
                           std::abs(position(m, joint.node_a[1]).x - 0.1) < 1e-9 &&
                           std::abs(position(m, joint.node_a[2]).x - 0.1) < 1e-9;
    double const o_p = m.joints.law(j).o_p, r = opening / o_p;
    double const force = at_middle ? concrete.f_t * (2 * r - r * r) * joint.area / 3 : 0; // Eq. 13
    opened += at_middle;
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(std::abs(w.joints.force[w.joints.side_a(j) + 3 * k]), force,
                  1e-12 * concrete.f_t * joint.area);
  }
  EXPECT_EQ(opened, 2);
}

} // namespace
} // namespace fissura::support
