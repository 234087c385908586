#include <gtest/gtest.h>

#include "support/two_blocks.hpp"

namespace fissura {
namespace {

using support::motion_of;
using support::Stepper;

constexpr double g = 9.81;

/// A block on a base that is held; gravity may lean, which is the same as a slope.
struct OnBase {
  Stepper t;
  OnBase(double friction, double slope, double length, double damping)
      : t(make(friction, slope, length, damping)) {}
  static model::Case make(double friction, double slope, double length, double damping) {
    auto c = support::two_blocks(
        support::block_of("base", {0, 0, -0.1}, {length, 0.2, 0}, {static_cast<int>(length / 0.1), 2, 1}),
        support::block_of("block", {0.05, 0.03, 0}, {0.15, 0.13, 0.1}, {1, 1, 1}), friction);
    c.supports = {support::support_at("held", support::group("base"), {true, true, true})};
    c.gravity.on = true;
    c.gravity.direction = {std::sin(slope), 0, -std::cos(slope)};
    c.gravity.curve = support::ramp(g, 0.02);
    c.run.mass_damping = damping;
    return c;
  }
  Vec3 mean_displacement() const {
    Vec3 sum;
    int count = 0;
    for (int tet = 0; tet < t.m.tet_count(); ++tet) {
      if (t.m.mesh.tet_group[tet] != 1) continue;
      for (int c = 0; c < 4; ++c, ++count)
        for (int r = 0; r < 3; ++r) sum[r] += t.s.u(model::node_of(tet, c), r);
    }
    return sum / count;
  }
};

// Requirement: a block sliding over the faces of another one stops after v^2/(2 mu g) within 1 %.
TEST(Friction, stops_a_sliding_block) {
  double const mu = 0.4, v = 1;
  OnBase b(mu, 0, 0.6, 0);
  b.t.advance(static_cast<long>(0.05 / b.t.m.dt)); // settle under gravity
  Vec3 const start = b.mean_displacement();
  for (int tet = 0; tet < b.t.m.tet_count(); ++tet)
    if (b.t.m.mesh.tet_group[tet] == 1)
      for (int c = 0; c < 4; ++c) b.t.s.v(model::node_of(tet, c), 0) += v;
  b.t.advance(static_cast<long>(0.3 / b.t.m.dt));
  Vec3 const stopped = b.mean_displacement();
  b.t.advance(static_cast<long>(0.05 / b.t.m.dt));
  EXPECT_NEAR(b.mean_displacement().x - start.x, v * v / (2 * mu * g), 0.01 * v * v / (2 * mu * g));
  EXPECT_LT(norm(b.mean_displacement() - stopped), 1e-3 * 0.05 * v) << "but for its vibrations it is at rest";
}

// Requirement: a block at rest on a slope below the friction angle creeps by less than 1e-6 of its size per
// second.
TEST(Friction, holds_a_block_on_a_slope) {
  OnBase b(0.4, std::atan(0.3), 0.3, 200);
  b.t.advance(static_cast<long>(0.2 / b.t.m.dt));
  Vec3 const start = b.mean_displacement();
  double const time = 0.5;
  b.t.advance(static_cast<long>(time / b.t.m.dt));
  EXPECT_LT(norm(b.mean_displacement() - start) / time, 1e-6 * 0.1);
}

// Requirement: a block on a slope above the friction angle slides down with g (sin - mu cos) within 1 %.
TEST(Friction, lets_a_block_slide_down_a_steep_slope) {
  double const mu = 0.3, slope = std::atan(0.6);
  OnBase b(mu, slope, 0.6, 0);
  b.t.advance(static_cast<long>(0.05 / b.t.m.dt));
  double const before = motion_of(b.t, 1).momentum.x, from = b.t.s.time;
  b.t.advance(static_cast<long>(0.2 / b.t.m.dt));
  double const rate = (motion_of(b.t, 1).momentum.x - before) / (2.5 * (b.t.s.time - from));
  double const expected = g * (std::sin(slope) - mu * std::cos(slope));
  EXPECT_NEAR(rate, expected, 0.01 * expected);
}

} // namespace
} // namespace fissura
