// What an engineer with experience would say before the run.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "fissura/sim/advice.hpp"
#include "fissura/sim/progress.hpp"
#include "support/cases.hpp"

namespace fissura::support {
namespace {

/// A cantilever along x, pushed sideways along z.
model::Case cantilever(int cells_over_height, model::Curve curve, bool is_velocity) {
  auto c = box_case({10, 4, cells_over_height}, {1.0, 0.2, 0.2}, 0.1);
  c.supports = {support_at("root", plane(0, 0), {true, true, true})};
  c.motions = {motion_at("tip", plane(0, 1.0), 2, std::move(curve), is_velocity)};
  return c;
}

std::vector<std::string> warnings_of(model::Case const& c) {
  sim::BuildReport report;
  sim::build_model(c, report);
  return report.warnings;
}

bool says(std::vector<std::string> const& warnings, std::string const& text) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](auto const& w) { return w.find(text) != std::string::npos; });
}

// Requirement: fewer than eight elements over the height of a member that is bent are a warning, eight are
// not.
TEST(Advice, ElementsOverABentHeight) {
  auto const slow = ramp(1e-5, 0.1);
  EXPECT_TRUE(says(warnings_of(cantilever(5, slow, false)), "about 5.0 elements over the height along z"));
  EXPECT_FALSE(says(warnings_of(cantilever(8, slow, false)), "over the height"));
}

// Requirement: a member that is pulled along its length is not told about its height.
TEST(Advice, PulledMembersAreNotBent) {
  auto c = cantilever(5, ramp(1e-5, 0.1), false);
  c.motions.front().axis = 0;
  EXPECT_FALSE(says(warnings_of(c), "over the height"));
}

// Requirement: the progress line never exceeds the terminal, whatever its width; colours only when asked.
TEST(Progress, BarFitsTheTerminal) {
  sim::Standing const s{0.38, 0.0305, 16, 3.7e-5, 507, 64, 13, 0};
  for (int const width : {20, 40, 80, 200}) {
    auto const line = sim::progress_bar_line(s, width, false);
    EXPECT_LT(line.size(), static_cast<std::size_t>(width));
    EXPECT_EQ(line.find('\x1b'), std::string::npos);
  }
  EXPECT_NE(sim::progress_bar_line(s, 80, true).find("\x1b[36m"), std::string::npos);
  EXPECT_NE(sim::progress_line(s).find("38.0 %"), std::string::npos);
  EXPECT_NE(sim::progress_line({}).find("left ?"), std::string::npos);
}

} // namespace
} // namespace fissura::support
