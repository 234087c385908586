#include "fissura/sim/bench_scenes.hpp"

#include <gtest/gtest.h>

#include "fissura/concrete/concrete.hpp"
#include "fissura/core/error.hpp"
#include "fissura/sim/bench.hpp"
#include "fissura/sim/build_model.hpp"
#include "fissura/step/advance.hpp"

namespace fissura::sim {
namespace {

struct Built {
  model::Model m;
  state::State s;

  Built(char const* name, long tets) {
    BuildReport report;
    auto const& scene = bench_scene(name);
    m = build_model(scene.make_case(tets), report);
    s = step::make_state(m);
    scene.prepare(m, s);
  }
};

// Requirement: scenes have about the size asked for and the damage that their names promise.
TEST(BenchScenes, are_what_they_are_called) {
  Built const uncracked("uncracked", 2000), half("half_damaged", 2000), pieces("fragmented", 3000);
  EXPECT_NEAR(uncracked.m.tet_count(), 2000, 300);
  EXPECT_EQ(concrete::count_joints(uncracked.m, uncracked.s).damaged, 0);
  auto const n = concrete::count_joints(half.m, half.s);
  EXPECT_NEAR(n.damaged, 0.5 * half.m.joint_count(), 0.02 * half.m.joint_count());
  EXPECT_EQ(n.broken, 0);
  auto const b = concrete::count_joints(pieces.m, pieces.s);
  EXPECT_EQ(b.damaged, b.broken);
  EXPECT_NEAR(b.broken, 0.1 * pieces.m.joint_count(), 0.05 * pieces.m.joint_count());
  EXPECT_GT(Built("beam", 2000).m.bars.joints.size(), 100U);
}

// Requirement: the line that other tools read says how many nanoseconds a tet and step take.
TEST(Bench, prints_nanoseconds_per_tet_step) {
  BenchOptions options;
  options.scene = "half_damaged", options.tets = 200, options.steps = 5;
  EXPECT_NE(bench(options).find(" ns per tet-step"), std::string::npos);
}

// Requirement: an unknown scene is refused with the names there are.
TEST(BenchScenes, refuses_unknown_names) {
  try {
    bench_scene("rubble");
    FAIL();
  } catch (core::Error const& e) {
    EXPECT_STREQ(e.what(), "no scene 'rubble'; there are uncracked, unstructured, beam, joint_inertia, "
                           "half_damaged, fragmented");
  }
}

} // namespace
} // namespace fissura::sim
