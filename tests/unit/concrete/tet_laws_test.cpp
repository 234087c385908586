// Two tet laws in one model.
#include <gtest/gtest.h>

#include "support/corner_forces.hpp"

namespace fissura {
namespace {

using namespace support;

struct Stretched {
  model::Model m = concrete_model(random_box_mesh(6, {2, 2, 2}, {0.2, 0.2, 0.2}));
  state::State s = concrete_state(m);
  state::Scratch w = concrete_scratch(m);

  Stretched() {
    Random random(11);
    for (int n = 0; n < node_count(m); ++n)
      set_node(s.u, n, random.vector(-2e-3, 2e-3));               // strains of some 5 %
    w.joints.force = core::Buffer<double>(w.joints.force.size()); // tets alone
  }
};

// Requirement: where tets of both laws lie side by side in a pack, each has the forces and the energy of its
// own law, with every kernel set.
TEST(TetLaws, each_tet_follows_its_own) {
  Stretched hyperelastic, paper, mixed;
  auto is_paper = [](int t) { return t % 3 == 0; };
  for (int t = 0; t < paper.m.tet_count(); ++t) {
    paper.m.tets.is_paper[static_cast<std::size_t>(t)] = 1;
    mixed.m.tets.is_paper[static_cast<std::size_t>(t)] = is_paper(t);
  }
  core::NodeField h, p, x;
  for (char const* name : {"scalar", "v2", ""}) {
    auto const& set = *name ? concrete::kernels(name) : concrete::kernels();
    corner_forces(hyperelastic.m, hyperelastic.s, hyperelastic.w, 0, h, set);
    corner_forces(paper.m, paper.s, paper.w, 0, p, set);
    corner_forces(mixed.m, mixed.s, mixed.w, 0, x, set);
    for (int n = 0; n < node_count(mixed.m); ++n) {
      auto const own = at_node(is_paper(n / 4) ? p : h, n), other = at_node(is_paper(n / 4) ? h : p, n);
      EXPECT_EQ(norm(at_node(x, n) - own), 0) << name << ", node " << n;
      EXPECT_GT(norm(at_node(x, n) - other), 1e-3 * norm(own)) << name << ", node " << n;
    }
  }
  double const low = std::min(concrete::strain_energy(hyperelastic.m, hyperelastic.s),
                              concrete::strain_energy(paper.m, paper.s)),
               high = std::max(concrete::strain_energy(hyperelastic.m, hyperelastic.s),
                               concrete::strain_energy(paper.m, paper.s)),
               both = concrete::strain_energy(mixed.m, mixed.s);
  EXPECT_LT(low, both);
  EXPECT_LT(both, high);
}

} // namespace
} // namespace fissura
