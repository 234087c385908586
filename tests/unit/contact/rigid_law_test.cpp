// The law at a point that touches a rigid body.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fissura/contact/rigid_law.hpp"

namespace fissura::contact {
namespace {

RigidLaw const law{1e12, 0.6};

// Requirement: pressure is k_n g; below the friction limit the traction is k_t times the slip, back to zero
// without loss; beyond it mu times the pressure, and the rest of the work is lost.
TEST(RigidLaw, sticks_then_slides) {
  Vec3 const n{0, 0, 1};
  RigidMemory memory;
  double const g = 1e-6, limit = 0.6 * law.k_n * g / law.k_t();
  auto t = rigid_traction(law, memory, g, n, {0.5 * limit, 0, 0});
  EXPECT_NEAR(t.on_concrete.z, 1e6, 1e-6);
  EXPECT_NEAR(t.on_concrete.x, -0.3e6, 1e-6);
  EXPECT_EQ(t.lost, 0);
  t = rigid_traction(law, memory, g, n, {-0.5 * limit, 0, 0});
  EXPECT_NEAR(t.on_concrete.x, 0, 1e-6);
  EXPECT_EQ(t.lost, 0);
  double lost = 0;
  for (int i = 0; i < 1000; ++i) lost += rigid_traction(law, memory, g, n, {0, 0.01 * limit, 0}).lost;
  EXPECT_NEAR(lost, 0.6e6 * 9 * limit, 1e-6 * lost);
}

// Requirement: a face that comes free while it overlaps a body feels no force until it goes deeper, and the
// overlap left to it never grows again: on random paths with and without slip nothing is
// created: what is stored and lost is what was put in, within 1e-4 of what went to and fro.
TEST(RigidLaw, creates_no_energy) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> move(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    RigidMemory memory{trial % 2 ? 2e-6 : 0, {}};
    double g = 2e-6, work = 0, moved = 0, lost = 0;
    Vec3 const n{0, 0, 1};
    Vec3 step; // a motion that changes slowly: many steps to a swing
    Vec3 before = rigid_traction(law, memory, g, n, {}).on_concrete;
    for (int i = 0; i < 2000; ++i) {
      step = 0.98 * step + 1e-9 * Vec3{move(random), move(random), move(random)};
      if (g - step.z < 0) step.z = 0;
      g -= step.z;
      auto const t = rigid_traction(law, memory, g, n, step);
      double const done = -0.5 * dot(before + t.on_concrete, step);
      work += done;
      moved += std::abs(done);
      before = t.on_concrete;
      lost += t.lost;
    }
    double const start = trial % 2 ? 0 : 0.5 * law.k_n * 4e-12;
    EXPECT_LE(rigid_stored(law, memory, g) + lost, start + work + 1e-4 * (start + moved));
    EXPECT_GE(lost, -1e-4 * (start + moved));
  }
}

// Requirement: the spring follows a normal that turns with its length, so turning alone stores nothing.
TEST(RigidLaw, keeps_the_stretch_of_a_turning_spring) {
  RigidMemory memory{0, {1e-8, 0, 0}};
  for (int i = 0; i < 100; ++i) {
    double const a = 0.01 * i;
    rigid_traction(law, memory, 1e-6, {std::sin(a), 0, std::cos(a)}, {});
    EXPECT_NEAR(norm(memory.stretch), 1e-8, 1e-20);
  }
}

} // namespace
} // namespace fissura::contact
