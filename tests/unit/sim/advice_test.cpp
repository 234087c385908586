// What an engineer with experience would say before the run.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "fissura/rebar/rebar.hpp"
#include "fissura/sim/advice.hpp"
#include "fissura/sim/hindsight.hpp"
#include "fissura/sim/progress.hpp"
#include "support/cases.hpp"
#include "support/concrete_model.hpp"

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

model::Curve table(std::vector<double> times, std::vector<double> values) {
  model::Curve c;
  c.kind = model::Curve::Kind::table;
  c.times = std::move(times), c.values = std::move(values);
  return c;
}

// Requirement: a motion by a table is warned of like any other when it is fast enough to crack the concrete,
// be it a table of displacements or of velocities; a slow one is not.
TEST(Advice, TablesThatMoveFast) {
  EXPECT_TRUE(says(warnings_of(cantilever(8, table({0, 1e-3}, {0, 2e-3}), false)), "`tip` reaches 2 m/s"));
  EXPECT_TRUE(says(warnings_of(cantilever(8, table({0, 1}, {3, 0}), true)), "`tip` reaches 3 m/s"));
  EXPECT_FALSE(says(warnings_of(cantilever(8, table({0, 1}, {0, 2e-3}), false)), "reaches"));
}

// Requirement: a table that does not begin at 0 comes as a jump.
TEST(Advice, TablesThatBeginWithAJump) {
  EXPECT_TRUE(says(warnings_of(cantilever(8, table({0, 1}, {0.01, 0.01}), true)), "`tip` comes as a jump"));
  EXPECT_FALSE(says(warnings_of(cantilever(8, table({0, 1}, {0, 0.01}), true)), "comes as a jump"));
}

// Requirement: steel that is stressed past its yield strength where the concrete has not cracked, and so
// cannot yield, is named at the end of the run; steel at cracks is not.
TEST(Hindsight, NamesSteelThatCannotYield) {
  for (bool const cracked : {false, true}) {
    Stepper x(tie_case({4, 1, 1}, 1, 1));
    if (cracked) rebar::activate_all(x.m, x.s.bars);
    // Twice the strain at yield, and no joint opens.
    set_field(x.m, x.s.u, [](Vec3 X) { return Vec3{5e-3 * X.x, 0, 0}; });
    x.advance();
    auto const found = sim::steel_beyond_yield(x.m, x.s);
    EXPECT_EQ(found.size(), cracked ? 0u : 1u);
    EXPECT_EQ(says(found, "more than its f_y of 530 MPa"), !cracked);
  }
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
