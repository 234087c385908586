// One mass on one joint under central differences: a joint that is softer open than closed has steps below
// the stable one at which it gains energy from nowhere (docs/decisions/019-share-of-the-stable-step.md).
#include "fissura/laws/cohesive.hpp"
#include "support/cohesive_input.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace {
using namespace fissura;
using namespace fissura::laws;

struct Vibration {
  double kappa_before = 0, kappa = 0;
  double lost_over_put_in = 0; ///< dissipated over the energy it vibrated with at first
};

/// A unit mass on a joint that has been damaged until its open secant is `softness` of its closed stiffness.
/// It vibrates with 0.3 of the opening that would damage it further. `step`: over the stable one of the
/// closed joint.
Vibration vibrate(double softness, double step, int steps) {
  auto input = support::cohesive_input(false);
  input.straight = true;
  auto const p = make_cohesive_params(input);
  CohesiveHistory h;
  Dissipation lost;
  double const farthest = p.o_p / softness;
  Separation at{};
  for (Separation const to : {Separation{farthest, 0, 0}, Separation{}})
    cohesive_traction(p, h, to, at, false, lost), at = to;
  Vibration r{h.kappa};
  lost = {};
  double const dt = 2 * step / std::sqrt(p.k);
  double x = 0, v = 0.3 * farthest * std::sqrt(p.k);
  double const put_in = 0.5 * v * v;
  for (int i = 0; i < steps && h.kappa < 1; ++i) {
    Separation const now{x, 0, 0};
    auto const t = cohesive_traction(p, h, now, at, false, lost);
    at = now;
    v -= dt * t.sigma, x += dt * v;
  }
  r.kappa = h.kappa, r.lost_over_put_in = lost.mode_I / put_in;
  return r;
}

// Requirement: the resonance is one of three steps a period: a joint softer by a tenth when it is open breaks
// altogether at 0.89 of its stable step, with ten thousand times the energy that it vibrated with, and is not
// damaged at all at 0.85.
TEST(JointResonance, three_steps_a_period_break_a_joint_with_energy_from_nowhere) {
  auto const resonant = vibrate(0.9, 0.89, 20'000);
  EXPECT_EQ(resonant.kappa, 1);
  EXPECT_GT(resonant.lost_over_put_in, 1e4);
  auto const calm = vibrate(0.9, 0.85, 20'000);
  EXPECT_EQ(calm.kappa, calm.kappa_before);
  EXPECT_EQ(calm.lost_over_put_in, 0);
}

// Requirement: a joint with the same stiffness both ways is stable up to its limit.
TEST(JointResonance, there_is_none_without_a_kink) {
  auto const straight = vibrate(1 - 1e-9, 0.89, 20'000);
  EXPECT_EQ(straight.kappa, straight.kappa_before);
}

} // namespace
