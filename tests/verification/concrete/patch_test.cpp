// Constant strain on a random mesh without joints.
#include <gtest/gtest.h>

#include "support/corner_forces.hpp"

namespace fissura::support {
namespace {

Mat3 const gradient{{Vec3{2e-3, 1e-3, -3e-3}, Vec3{0.5e-3, -4e-3, 2e-3}, Vec3{-1e-3, 3e-3, 1e-3}}};

/// Cauchy stress of the hyperelastic law, T = [G (B - I) + lambda/2 (J^2 - 1) I]/J.
std::array<double, 6> exact_stress(model::ConcreteSpec const& c) {
  Mat3 const F = gradient + Mat3::identity(), B = F * transpose(F);
  double const G = c.E / (2 * (1 + c.nu)), lambda = c.E * c.nu / ((1 + c.nu) * (1 - 2 * c.nu)),
               J = determinant(F);
  Mat3 const T = (1 / J) * (G * (B - Mat3::identity()) + 0.5 * lambda * (J * J - 1) * Mat3::identity());
  return {T[0].x, T[1].y, T[2].z, T[0].y, T[1].z, T[0].z};
}

struct Patch {
  model::ConcreteSpec concrete = plain_concrete();
  model::Model m;
  state::State s;
  state::Scratch w;
  explicit Patch(std::uint64_t seed) {
    concrete.joints = false;
    m = concrete_model(random_box_mesh(seed, {4, 3, 3}, {0.4, 0.3, 0.3}), concrete);
    s = concrete_state(m);
    w = concrete_scratch(m);
    set_field(m, s.u, [](Vec3 X) { return gradient * X; });
  }
};

// Requirement: on a random mesh without joints a constant strain gives the exact stress in every tet, to
// 1e-12.
TEST(Patch, constant_strain_gives_the_exact_stress) {
  for (std::uint64_t const seed : {1, 2, 3}) {
    Patch p(seed);
    auto const exact = exact_stress(p.concrete);
    double scale = 0;
    for (double const x : exact) scale = std::max(scale, std::abs(x));
    for (int t = 0; t < p.m.tet_count(); ++t) {
      auto const stress = concrete::tet_stress(p.m, p.s, t);
      for (int i = 0; i < 6; ++i) ASSERT_NEAR(stress[i], exact[i], 1e-12 * scale) << "tet " << t;
    }
  }
}

// Requirement: under constant strain no net force acts on interior points, to 1e-12 of the forces that cancel
// there.
TEST(Patch, interior_points_are_in_balance) {
  Patch p(4);
  core::NodeField f;
  corner_forces(p.m, p.s, p.w, 0, f);
  std::vector<char> outer(p.m.mesh.points.size(), 0);
  for (auto const& b : p.m.adjacency.boundary)
    for (int const c : mesh::face_corners[b.face]) outer[p.m.mesh.tets[b.tet][c]] = 1;
  double scale = 0;
  for (double const x : f.values) scale = std::max(scale, std::abs(x));
  auto const sum = sum_at_points(p.m, f);
  int inner = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (outer[i]) continue;
    ++inner;
    EXPECT_LE(norm(sum[i]), 1e-12 * scale) << "point " << i;
  }
  EXPECT_EQ(inner, 3 * 2 * 2);
}

// Requirement: the same holds in the step: a bonded body that is stretched evenly accelerates only at its
// surface.
TEST(Patch, a_step_moves_only_the_surface) {
  Patch p(5);
  p.m.dt = 1e-7;
  concrete::tet_forces_and_integrate(p.m, p.s, p.w, {}, {});
  Vec3 const size{0.4, 0.3, 0.3};
  double inside = 0, outside = 0;
  for (int n = 0; n < node_count(p.m); ++n) {
    Vec3 const X = position(p.m, n);
    bool surface = false;
    for (int k = 0; k < 3; ++k) surface |= X[k] < 1e-9 || X[k] > size[k] - 1e-9;
    double& largest = surface ? outside : inside;
    largest = std::max(largest, norm(at_node(p.s.v, n)));
  }
  EXPECT_GT(outside, 0);
  EXPECT_LE(inside, 1e-11 * outside);
}

// Requirement: forces are the negative gradient of the stored energy, to the accuracy of central differences.
TEST(Patch, forces_are_the_gradient_of_the_energy) {
  Patch p(6);
  core::NodeField f;
  corner_forces(p.m, p.s, p.w, 0, f);
  for (int n = 0; n < 40; n += 7)
    for (int r = 0; r < 3; ++r) {
      double& u = p.s.u(n, r);
      double const u0 = u, h = 1e-6;
      u = u0 + h;
      double const up = concrete::strain_energy(p.m, p.s);
      u = u0 - h;
      double const down = concrete::strain_energy(p.m, p.s);
      u = u0;
      EXPECT_NEAR(f(n, r), -(up - down) / (2 * h), 1e-5 * norm(at_node(f, n)));
    }
}

} // namespace
} // namespace fissura::support
