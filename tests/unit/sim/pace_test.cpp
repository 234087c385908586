// Quasi-static pace control.
#include "fissura/sim/pace.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "fissura/sim/history.hpp"
#include "fissura/sim/run.hpp"
#include "support/cases.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::support {
namespace {

/// An elastic bar, pulled at one end.
model::Case slow_pull(double pace) {
  auto c = box_case({6, 1, 1}, {0.6, 0.1, 0.1}, 20e-3);
  c.concretes = {unbreakable_concrete()};
  c.supports = {support_at("left", plane(0, 0), {true, true, true})};
  c.motions = {motion_at("pull", plane(0, 0.6), 0, ramp(0.01, 4e-3), true)};
  auto force = gauge("force", model::GaugeSpec::Kind::reaction);
  force.of = {"pull"};
  auto moved = gauge("moved", model::GaugeSpec::Kind::displacement);
  moved.where = plane(0, 0.6);
  c.gauges = {force, moved};
  c.run.pace = pace;
  c.run.mass_damping = 500;
  c.run.joint_inertia = model::JointInertia::off;
  return c;
}

struct Rows {
  std::vector<std::string> names;
  std::vector<double> values;
  std::size_t count() const { return values.size() / names.size(); }
  double at(std::size_t row, std::string const& name) const {
    auto const i = std::find(names.begin(), names.end(), name) - names.begin();
    return values.at(row * names.size() + static_cast<std::size_t>(i));
  }
};

struct Ran {
  Rows rows;
  nlohmann::json summary;
};
Ran run(model::Case const& c) {
  sim::RunOptions o;
  o.quiet = true, o.threads = 1;
  sim::Run r(c, o);
  r.open();
  while (r.step()) {
  }
  r.finish();
  Ran result;
  for (auto const& column : r.history().columns()) result.rows.names.push_back(column.name);
  result.rows.values.assign(r.history().rows().begin(), r.history().rows().end());
  result.summary = nlohmann::json::parse(r.summary());
  return result;
}

// Requirement: a slow elastic pull is driven faster with pace control, over the same displacements, with the
// same force to 1 % of its largest.
TEST(Pace, slow_loading_takes_fewer_steps_and_gives_the_same_curve) {
  auto const steady = run(slow_pull(1)), paced = run(slow_pull(4));
  EXPECT_LT(paced.summary["steps"].get<double>(), 0.6 * steady.summary["steps"].get<double>());
  EXPECT_GT(paced.summary["mean_pace"].get<double>(), 1.6);
  EXPECT_FALSE(steady.summary.contains("mean_pace"));
  std::size_t const last = paced.rows.count() - 1;
  double const largest = paced.rows.at(last, "force");
  ASSERT_GT(largest, 0);
  double const slope =
      steady.rows.at(steady.rows.count() - 1, "force") / steady.rows.at(steady.rows.count() - 1, "moved");
  for (std::size_t i = 0; i <= last; ++i) {
    EXPECT_NEAR(paced.rows.at(i, "force"), slope * paced.rows.at(i, "moved"), 0.01 * largest) << i;
    // the curve: a velocity of 0.01 m/s that is reached smoothly, half of it on the way
    double const tau = paced.rows.at(i, "load_time");
    if (tau > 4e-3) {
      EXPECT_NEAR(paced.rows.at(i, "moved"), 0.01 * (tau - 2e-3), 1e-9) << i;
    }
    EXPECT_GE(paced.rows.at(i, "pace"), 1 - 1e-12);
    EXPECT_LE(paced.rows.at(i, "pace"), 4 + 1e-12);
  }
  EXPECT_LT(paced.summary["energy_residual"].get<double>(), 1e-3);
}

// Requirement: with pace control the log forecasts the steps as an upper limit, and where inertia matters it
// names the key that helps.
TEST(Pace, is_known_to_the_log) {
  output::testing::TemporaryFolder const folder;
  auto const said = [&](double pace) {
    sim::RunOptions o;
    o.out = folder / "run", o.quiet = true, o.force = true, o.threads = 1, o.until = 1e-3;
    sim::run_case(slow_pull(pace), o);
    return output::testing::read_bytes(folder / "run/log.txt");
  };
  auto const steady = said(1), paced = said(4);
  EXPECT_NE(paced.find("; at most "), std::string::npos) << paced;
  EXPECT_NE(paced.find("inertia matters (else lower `pace_kinetic`"), std::string::npos) << paced;
  EXPECT_EQ(steady.find("at most "), std::string::npos) << steady;
  EXPECT_EQ(steady.find("pace_kinetic"), std::string::npos) << steady;
}

// Requirement: without pace control the loads have the time of the run, to the bit.
TEST(Pace, off_it_changes_nothing) {
  Stepper p(slow_pull(1));
  for (int i = 0; i < 1000; ++i) {
    p.advance();
    ASSERT_EQ(p.s.load_time(), p.s.time);
    ASSERT_EQ(p.s.load_time(p.m.dt), p.s.time + p.m.dt);
  }
}

// Requirement: the pace rises while the kinetic energy is low, falls ten times faster while it is high, and
// never leaves the range from 1 to `pace`.
TEST(Pace, stays_in_its_range) {
  Stepper p(slow_pull(4));
  sim::PaceControl const control(p.m);
  ASSERT_TRUE(control.is_on());
  EXPECT_FALSE(sim::PaceControl(Stepper(slow_pull(1)).m).is_on());
  auto& s = p.s;
  auto const after = [&](double kinetic, double internal) {
    control.steer(kinetic, internal, s);
    s.pace *= std::pow(s.pace_growth, p.m.source.run.energy_every);
    return s.pace;
  };
  double const once = after(0, 1);
  EXPECT_GT(once, 1);
  for (int i = 0; i < 100'000; ++i) after(1e-5, 1);
  EXPECT_NEAR(s.pace, 4, 1e-9);
  double const up = std::log(once), down = -std::log(after(1, 1e-9) / 4);
  EXPECT_NEAR(down / up, 10, 0.01);
  for (int i = 0; i < 100'000; ++i) after(1, 0);
  EXPECT_NEAR(s.pace, 1, 1e-9);
  after(0, 0); // at rest, nothing held
  EXPECT_TRUE(std::isfinite(s.pace));
}

} // namespace
} // namespace fissura::support
