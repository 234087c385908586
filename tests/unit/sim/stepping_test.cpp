// A run taken step by step.
#include <gtest/gtest.h>

#include <filesystem>

#include <nlohmann/json.hpp>

#include "fissura/sim/history.hpp"
#include "fissura/sim/run.hpp"
#include "support/cases.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::support {
namespace {

using output::testing::TemporaryFolder;

model::Case tie() {
  auto c = tie_case({4, 1, 1}, 6e-4, 1);
  auto f = gauge("force", model::GaugeSpec::Kind::reaction);
  f.of = {"pull"};
  c.gauges = {f};
  return c;
}

// Requirement: a run stepped by hand, without a folder, ends in the same bits as one that leaves a folder,
// and keeps the same rows in memory.
TEST(Stepping, is_the_same_run) {
  TemporaryFolder const folder;
  sim::RunOptions o;
  o.quiet = true, o.threads = 1;
  sim::Run alone(tie(), o);
  alone.open();
  while (alone.step()) EXPECT_FALSE(alone.ended());
  EXPECT_TRUE(alone.ended());
  EXPECT_FALSE(alone.step()) << "nothing follows the end";
  EXPECT_EQ(alone.finish().status, "complete");

  o.out = folder / "run";
  sim::Run written(tie(), o);
  written.open();
  while (written.step()) {
  }
  written.finish();
  auto const a = nlohmann::json::parse(alone.summary()), b = nlohmann::json::parse(written.summary());
  EXPECT_EQ(a["state_hash"], b["state_hash"]);
  EXPECT_EQ(alone.state().step, written.state().step);
  EXPECT_EQ(alone.history().rows(), written.history().rows());
  EXPECT_EQ(alone.history().rows().size() % alone.history().columns().size(), 0u);
  EXPECT_EQ(alone.history().columns()[0].name, "time");
  EXPECT_EQ(alone.history().columns()[1].name, "force");
}

} // namespace
} // namespace fissura::support
