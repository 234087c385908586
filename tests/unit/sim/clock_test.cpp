#include <gtest/gtest.h>

#include "fissura/sim/clock.hpp"
#include "fissura/sim/progress.hpp"

namespace fissura::sim {
namespace {

// Requirement: Due fires at 0 and then once per interval, however long the steps are.
TEST(Due, fires_once_per_interval) {
  Due due(0.1);
  int fired = 0;
  for (int i = 0; i <= 1000; ++i) {
    double const t = 1e-3 * i;
    if (!due.at(t)) continue;
    ++fired;
    due.done(t);
    EXPECT_FALSE(due.at(t));
  }
  EXPECT_EQ(fired, 11);
  Due coarse(0.1);
  fired = 0;
  for (double t = 0; t < 1.01; t += 0.25)
    if (coarse.at(t)) ++fired, coarse.done(t);
  EXPECT_EQ(fired, 5);
}

// Requirement: an interval of 0 or less never fires.
TEST(Due, can_be_off) {
  EXPECT_FALSE(Due(0).at(0));
  EXPECT_FALSE(Due(-1).at(5));
}

// Requirement: rounding of multiples neither skips nor doubles a firing over many intervals.
TEST(Due, does_not_drift) {
  double const dt = 1.0 / 3000;
  Due due(1.0 / 300);
  int fired = 0;
  for (int i = 0; i < 30000; ++i)
    if (due.at(i * dt)) {
      EXPECT_EQ(i % 10, 0);
      ++fired;
      due.done(i * dt);
    }
  EXPECT_EQ(fired, 3000);
}

// Requirement: what goes on from a checkpoint fires when it would have fired; with another interval, at the
// next multiple of that.
TEST(Due, goes_on) {
  Due saved(0.1);
  for (int i = 0; i <= 25; ++i)
    if (saved.at(0.01 * i)) saved.done(0.01 * i);
  Due same(0.1), other(0.07), off(0);
  EXPECT_TRUE(same.go_on(saved, 0.26) && other.go_on(saved, 0.26) && off.go_on(saved, 0.26));
  EXPECT_FALSE(same.at(0.29));
  EXPECT_TRUE(same.at(0.3));
  EXPECT_FALSE(other.at(0.27));
  EXPECT_TRUE(other.at(0.28));
  EXPECT_FALSE(off.at(1));
  EXPECT_TRUE(other.go_on(saved, 0.35));
  EXPECT_TRUE(other.at(0.35)) << "a multiple itself is still to come";
  EXPECT_FALSE(Due(1e-300).go_on(saved, 1)) << "no number of times";
}

// Requirement: durations read in the largest fitting units.
TEST(Progress, durations_are_readable) {
  EXPECT_EQ(readable_duration(12.2), "12 s");
  EXPECT_EQ(readable_duration(200), "3 min 20 s");
  EXPECT_EQ(readable_duration(3720), "1 h 02 min");
}

// Requirement: the time left comes from the speed over the window: at steady progress it is what remains.
TEST(Progress, estimates_the_time_left) {
  Progress p;
  EXPECT_LT(p.eta(0, 0), 0);
  for (int i = 1; i <= 100; ++i) { // 10 s for the whole, then twice as fast
    double const wall = 0.1 * i + (i > 50 ? 0.05 * (50 - i) : 0);
    double const left = p.eta(0.01 * i, wall);
    if (i == 50) {
      EXPECT_NEAR(left, 5, 1e-9);
    }
    if (i == 90) {
      EXPECT_NEAR(left, 0.5, 1e-9) << "only the window counts";
    }
  }
}

} // namespace
} // namespace fissura::sim
