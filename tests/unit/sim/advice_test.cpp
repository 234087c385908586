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

// Requirement: a motion whose kinetic energy passes a quarter of the elastic energy at cracking is too fast;
// the warning names a speed at which the share is 4 %.
TEST(Advice, FastMotions) {
  auto c = cantilever(8, ramp(1.0, 0.5), true);
  auto const& concrete = c.concretes.front();
  double const limit = 0.5 * concrete.f_t / std::sqrt(concrete.density * concrete.E);
  EXPECT_NEAR(sim::speed_share(concrete, limit), 0.25, 1e-12);
  c.motions.front().curve.value = 1.05 * limit;
  EXPECT_TRUE(says(warnings_of(c), "motion `tip` moves at"));
  c.motions.front().curve.value = 0.95 * limit;
  EXPECT_FALSE(says(warnings_of(c), "motion `tip` moves at"));
}

// Requirement: cases that are dynamic by intent are not told to go slowly.
TEST(Advice, DynamicCasesMayBeFast) {
  auto c = cantilever(8, ramp(5.0, 0.5), true);
  model::InitialVelocitySpec thrown;
  thrown.velocity = {0, 0, 1};
  c.initial_velocities = {thrown};
  EXPECT_FALSE(says(warnings_of(c), "moves at"));
}

// Requirement: a velocity that starts with a jump, or rises within few wave transits, is a warning with the
// rise that helps.
TEST(Advice, SuddenStarts) {
  EXPECT_TRUE(says(warnings_of(cantilever(8, constant(0.1), true)), "a sudden start cracks the grip"));
  EXPECT_FALSE(says(warnings_of(cantilever(8, ramp(0.1, 0.05), true)), "a sudden start"));
}

// Requirement: mass damping that carries more than 5 % of what cracks the mean section is a warning with a
// value that does not.
TEST(Advice, StrongDamping) {
  auto c = cantilever(8, ramp(0.1, 0.05), true);
  c.run.mass_damping = 2000;
  EXPECT_TRUE(says(warnings_of(c), "mass damping of 2000 1/s carries up to"));
  c.run.mass_damping = 10;
  EXPECT_FALSE(says(warnings_of(c), "mass damping of"));
}

// Requirement: the largest speed of a curve: of a smooth ramp its steepest slope, of a table its steepest
// piece, of cycles the mean slope of their largest.
TEST(Advice, LargestSpeeds) {
  EXPECT_DOUBLE_EQ(sim::largest_speed(ramp(0.2, 0.5), false), 1.875 * 0.4);
  EXPECT_DOUBLE_EQ(sim::largest_speed(ramp(0.2, 0.5), true), 0.2);
  EXPECT_DOUBLE_EQ(sim::largest_speed(constant(0.2), false), 0);
  model::Curve table;
  table.kind = model::Curve::Kind::table;
  table.times = {0, 1, 3}, table.values = {0, 2, -4};
  EXPECT_DOUBLE_EQ(sim::largest_speed(table, false), 3);
  EXPECT_DOUBLE_EQ(sim::largest_speed(table, true), 4);
  model::Curve cycles;
  cycles.kind = model::Curve::Kind::cycles;
  cycles.peaks = {1, 2}, cycles.period = 4;
  EXPECT_DOUBLE_EQ(sim::largest_speed(cycles, false), 2);
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
