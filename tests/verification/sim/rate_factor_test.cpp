// Strengths that grow with the strain rate, in the whole program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fissura/concrete/concrete.hpp"
#include "fissura/laws/rate_factor.hpp"
#include "support/cases.hpp"

namespace fissura::support {
namespace {

struct Pull {
  double peak = 0; ///< largest mean stress at the fixed end [Pa]
  int damaged = 0;
};

/// A prism, so small that a wave takes no time to cross it, that starts with the uniform velocity gradient
/// `rate` [1/s]: no waves.
Pull pull(model::RateFactor factor, double rate, double noise = 0) {
  double const length = 0.01 / rate, width = 0.25 * length;
  auto c = box_case({4, 1, 1}, {length, width, width}, 1);
  c.concretes[0].rate_factor = factor;
  c.run.joint_inertia = model::JointInertia::off;
  c.concretes[0].nu = 0;
  c.concretes[0].penalty = 200 * c.concretes[0].E;
  c.supports = {support_at("left", plane(0, 0), {true, false, false})};
  c.motions = {motion_at("right", plane(0, length), 0, constant(rate * length), true)};
  Stepper x(c);
  set_field(x.m, x.s.v, [&](Vec3 X) { return Vec3{rate * X.x, 0, 0}; });
  std::uint64_t seed = 7;
  for (int n = 0; n < node_count(x.m) && noise > 0; ++n)
    for (int r = 0; r < 3; ++r)
      seed = seed * 6364136223846793005u + 1442695040888963407u,
      x.s.v(n, r) += noise * (static_cast<double>(seed >> 40) / 8388608.0 - 1);
  x.s.prescribed_velocity.back() = rate * length;
  x.s.held.assign(x.s.held.size(), 1);
  Pull p;
  double const end = 1.3 * laws::rate_factor_mc2010(rate) * c.concretes[0].f_t / c.concretes[0].E / rate;
  while (x.s.time < end) {
    x.advance();
    p.peak = std::max(p.peak, -x.s.reaction[0] / (width * width));
  }
  p.damaged = concrete::count_joints(x.m, x.s).damaged;
  return p;
}

// Requirement: a prism strained at 0.1, 10 and 100 1/s cracks at f_t times the Model Code's factor for that
// rate, within 2 %; without the option at f_t.
TEST(RateFactor, raises_the_strength) {
  double const f_t = plain_concrete().f_t;
  for (double const rate : {0.1, 10.0, 100.0}) {
    auto const p = pull(model::RateFactor::mc2010, rate);
    EXPECT_NEAR(p.peak, f_t * laws::rate_factor_mc2010(rate), 0.02 * p.peak) << rate;
    EXPECT_GT(p.damaged, 0);
    RecordProperty("rate_" + std::to_string(rate), std::to_string(p.peak / f_t));
  }
  EXPECT_NEAR(pull(model::RateFactor::none, 0.1).peak, f_t, 0.02 * f_t);
}

// Requirement: a single step's noise does not decide: with random velocities of the size of the prism's own
// on every node at the start the strength stays within 5 %.
TEST(RateFactor, is_averaged) {
  double const rate = 10, own = 0.01; // [m/s] at the moving end
  auto const quiet = pull(model::RateFactor::mc2010, rate),
             noisy = pull(model::RateFactor::mc2010, rate, 0.5 * own);

  EXPECT_NEAR(noisy.peak, quiet.peak, 0.05 * quiet.peak);
}

} // namespace
} // namespace fissura::support
