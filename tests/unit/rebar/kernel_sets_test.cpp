// Packs of bar elements and bar joints against the same kernels one at a time.
#include <gtest/gtest.h>

#include "bar_model.hpp"
#include "fissura/core/error.hpp"
#include "fissura/rebar/kernels.hpp"

namespace fissura::test {
namespace {

/// Inclined bars through a random mesh, all of whose tets have moved and turned a little on their own.
BarModel shaken() {
  auto mesh = support::random_box_mesh(7, {5, 3, 3}, {0.5, 0.3, 0.3});
  BarModel x(std::move(mesh), {bar_along({{0.02, 0.03, 0.05}, {0.48, 0.26, 0.27}}, 0.012),
                               bar_along({{0.03, 0.2, 0.21}, {0.3, 0.22, 0.08}, {0.45, 0.07, 0.1}}, 0.016)});
  support::Random random(5);
  for (double& u : x.s.u.values) u = random.uniform(-1e-3, 1e-3);
  return x;
}

/// All that the kernels write.
std::vector<double> results(BarModel& x, rebar::BarKernels const& kernels) {
  auto const pass = rebar::bar_pass(x.m, x.s, x.w);
  kernels.stretch_elements(pass, 0, x.w.bars.element_lanes.size());
  kernels.move_joints(pass, 0, x.w.bars.joint_lanes.size());
  std::vector<double> all(x.s.bars.elongation);
  auto add = [&](state::BarScratch::Padded const& v) { all.insert(all.end(), {v.x, v.y, v.z, v.pad}); };
  for (auto const& e : x.w.bars.element) {
    add(e.direction);
    for (auto const& g : e.gradients) add(g);
  }
  for (auto const& j : x.w.bars.joint) {
    for (auto const& v : {j.r, j.across_1, j.across_2}) add(v);
    all.insert(all.end(), {j.axial, j.t_1, j.t_2, j.may_separate});
    all.insert(all.end(), j.w_a.begin(), j.w_a.end());
    all.insert(all.end(), j.w_b.begin(), j.w_b.end());
  }
  return all;
}

class BarKernelSets : public testing::TestWithParam<char const*> {};

// Requirement: every kernel set the machine can run gives what the scalar one gives, to rounding, for all
// elements and joints: also those behind the last full pack.
TEST_P(BarKernelSets, agree_with_the_scalar_ones) {
  rebar::BarKernels const* set = nullptr;
  try {
    set = &rebar::bar_kernels(GetParam());
  } catch (core::Error const&) {
    GTEST_SKIP() << "this machine cannot run them";
  }
  BarModel x = shaken();
  ASSERT_GT(x.m.bars.joints.size() % 8, 0u);
  auto const expected = results(x, rebar::bar_kernels("scalar"));
  for (auto& e : x.w.bars.element) e = {};
  for (auto& j : x.w.bars.joint) j = {};
  auto const found = results(x, *set);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-12 * std::max(1.0, std::abs(expected[i]))) << i;
}
INSTANTIATE_TEST_SUITE_P(All, BarKernelSets, testing::Values("v2", "v3", "v4"),
                         [](auto const& set) { return std::string(set.param); });

// Requirement: the transverse directions of a joint and its axis are unit vectors at right angles, and the
// weights of a point sum to 1, however the tets have moved.
TEST(BarKernels, give_frames_and_weights) {
  BarModel x = shaken();
  results(x, rebar::bar_kernels());
  for (auto const& j : x.w.bars.joint) {
    Vec3 const r = j.r, a = j.across_1, b = j.across_2;
    EXPECT_NEAR(norm(r), 1, 1e-14);
    EXPECT_NEAR(norm(a), 1, 1e-14);
    EXPECT_NEAR(dot(r, a), 0, 1e-14);
    EXPECT_NEAR(norm(b - cross(r, a)), 0, 1e-14);
    EXPECT_NEAR(j.w_a[0] + j.w_a[1] + j.w_a[2] + j.w_a[3], 1, 1e-12);
    EXPECT_NEAR(j.w_b[0] + j.w_b[1] + j.w_b[2] + j.w_b[3], 1, 1e-12);
  }
}

// Requirement: a joint is told to be surely intact if and only if at every crossing the jump is shorter than
// the one below which neither opening nor sliding can leave the undamaged range.
TEST(BarKernels, tell_which_faces_are_surely_intact) {
  BarModel x = shaken();
  int intact = 0;
  for (double const scale : {1.0, 1e-3, 3e-4, 1e-4}) {
    BarModel y = shaken();
    for (double& u : y.s.u.values) u *= scale;
    results(y, rebar::bar_kernels());
    for (std::size_t i = 0; i < y.m.bars.joints.size(); ++i) {
      auto const& joint = y.m.bars.joints[i];
      bool is_short = true;
      for (int f = joint.faces_begin; f < joint.faces_end; ++f) {
        auto const& face = y.m.bars.faces[static_cast<std::size_t>(f)];
        auto const& shared = y.m.adjacency.shared[static_cast<std::size_t>(face.shared_face)];
        Vec3 d;
        for (std::size_t k = 0; k < 3; ++k) {
          auto at = [&](int tet, int corner) { return y.s.u.at(model::node_of(tet, corner)); };
          d +=
              face.weights[k] * (at(shared.b.tet, shared.corner_b[k]) - at(shared.a.tet, shared.corner_a[k]));
        }
        is_short &= norm(d) < face.surely_intact;
      }
      EXPECT_EQ(y.w.bars.joint[i].may_separate == 0, is_short) << i;
      intact += is_short;
    }
  }
  EXPECT_GT(intact, 0);
  EXPECT_LT(intact, 4 * static_cast<int>(x.m.bars.joints.size()));
}

} // namespace
} // namespace fissura::test
