#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fissura/loads/path.hpp"

namespace fissura::loads {
namespace {

/// Gauge 0 reads the displacement of the path itself, gauge 1 ten times the displacement beyond `slack`.
struct Rig {
  model::MotionPath path;
  state::PathState s;
  double u = 0, largest_jump = 0, largest_bend = 0, slack = 0;
  std::vector<double> v; ///< one per step

  explicit Rig(std::vector<model::MotionPath::Target> targets) {
    path.speed = 0.1, path.turn = 5e-3;
    path.targets = std::move(targets);
  }
  std::vector<double> readings() const { return {u, 10 * (u - slack)}; }
  /// Steps until the path has ended and rests, looking at the gauges every 20 steps; says how long it took.
  double run(double dt = 1e-5) {
    double t = 0;
    for (int i = 0; i < 400000; ++i, t += dt) {
      if (i % 20 == 0) follow_path(path, s, t, readings());
      v.push_back(path_velocity(path, s, t + 0.5 * dt));
      u += dt * v.back();
      std::size_t const n = v.size();
      if (n > 1) largest_jump = std::max(largest_jump, std::abs(v[n - 1] - v[n - 2]));
      if (n > 2) largest_bend = std::max(largest_bend, std::abs(v[n - 1] - 2 * v[n - 2] + v[n - 3]));
      if (path_ended(path, s) && t > s.turned_at + path.turn) return t;
    }
    ADD_FAILURE() << "the path never ended";
    return t;
  }
};

// Requirement: the path turns where its gauges reach their targets, whatever side they come from, and comes
// to rest after the last one; it overshoots by 0.34 speed times turn at most, by half of it where it comes to
// rest.
TEST(Path, turns_where_gauges_reach_their_targets) {
  Rig r({{0, 2e-3}, {1, 0}, {0, 5e-3}, {0, -1e-3}});
  r.slack = 1e-3;
  double position = 0, highest = 0, lowest = 0;
  std::vector<double> turning;
  r.run();
  for (std::size_t i = 0; i < r.v.size(); ++i) {
    if (i > 0 && r.v[i] * r.v[i - 1] < 0) turning.push_back(position);
    position += 1e-5 * r.v[i];
    highest = std::max(highest, position), lowest = std::min(lowest, position);
  }
  double const over = 0.35 * 0.1 * 5e-3 + 20 * 1e-5 * 0.1;
  ASSERT_EQ(turning.size(), 3U);
  EXPECT_GE(turning[0], 2e-3);
  EXPECT_LE(turning[0], 2e-3 + over);
  EXPECT_LE(turning[1], 1e-3);
  EXPECT_GE(turning[1], 1e-3 - over);
  EXPECT_GE(turning[2], 5e-3);
  EXPECT_LE(turning[2], 5e-3 + over);
  EXPECT_LE(position, -1e-3);
  EXPECT_GE(position, -1e-3 - over - 0.16 * 0.1 * 5e-3);
  EXPECT_EQ(r.v.back(), 0);
  EXPECT_LE(*std::max_element(r.v.begin(), r.v.end()), 0.1 * (1 + 1e-12));
}

// Requirement: neither velocity nor acceleration jumps, also where a turn begins within a turn: their changes
// from step to step vanish with the step and with its square.
TEST(Path, is_smooth) {
  Rig coarse({{0, 2e-3}, {0, 1.999e-3}, {0, 2.0e-3}, {0, 0}}), fine = coarse;
  coarse.run(1e-5);
  fine.run(1e-6);
  // The largest slope and curvature of a smooth step from -v to +v over T are 3.75 v/T and 11.6 v/T^2.
  for (auto const& [rig, dt] : {std::pair{&coarse, 1e-5}, {&fine, 1e-6}}) {
    EXPECT_LE(rig->largest_jump, 4 * 0.1 / 5e-3 * dt);
    EXPECT_LE(rig->largest_bend, 24 * 0.1 / (5e-3 * 5e-3) * dt * dt);
  }
}

// Requirement: targets that are met already when their turn comes are passed at once, in order.
TEST(Path, passes_targets_that_are_met) {
  Rig r({{0, 1e-3}, {0, 1e-3}, {0, 3e-3}});
  r.u = 1e-3;
  EXPECT_EQ(follow_path(r.path, r.s, 0, r.readings()), 2);
  EXPECT_EQ(r.s.target, 2);
  EXPECT_GT(path_velocity(r.path, r.s, 1), 0);
}

} // namespace
} // namespace fissura::loads
