#include <gtest/gtest.h>

#include "fissura/parallel/parallel.hpp"
#include "support/two_blocks.hpp"

namespace fissura {
namespace {

using support::motion_of;
using support::Stepper;

/// A block flies at another one; where they meet is up to the offset.
struct Collision {
  Stepper t;
  support::Motion before;
  double energy_before = 0, largest_contact = 0, worst_energy = 0;

  Collision(Vec3 offset, Vec3 velocity, bool joints, double friction = 0)
      : t(support::two_blocks(
            support::block_of("a", {0, 0, 0}, {0.2, 0.2, 0.2}, {6, 6, 6}),
            support::block_of("b", Vec3{0.201, 0, 0} + offset, Vec3{0.401, 0.15, 0.15} + offset, {5, 5, 5}),
            friction, joints)) {
    support::set_velocity(t, 1, velocity);
    before = motion_of(t);
    energy_before = before.kinetic;
  }
  void fly(double time) {
    constexpr int readings = 20;
    for (int i = 0; i < readings; ++i) {
      t.advance(static_cast<long>(time / t.m.dt / readings));
      auto const& e = t.read();
      worst_energy =
          std::max(worst_energy, std::abs(e.held() + e.dissipated() - energy_before) / energy_before);
      largest_contact = std::max(largest_contact, e.contact);
    }
  }
};

void expect_conserved(Collision& c, double angular) {
  c.fly(0.04);
  auto const after = motion_of(c.t);
  double const size = norm(c.before.momentum);
  EXPECT_GT(c.largest_contact, 1e-4 * c.energy_before) << "they have not met";
  EXPECT_EQ(c.t.s.contact.stored, 0) << "they have not parted";
  EXPECT_LE(c.worst_energy, 1e-3);
  EXPECT_LE(norm(after.momentum - c.before.momentum), 1e-12 * size);
  EXPECT_LE(norm(after.spin - c.before.spin), angular * size * 0.4);
}

// Requirement: a frictionless head-on collision of elastic blocks conserves energy to 0.1 %, linear momentum
// to 1e-12 and, without joints, angular momentum to 1e-10.
TEST(Collision, head_on_conserves) {
  Collision c({0, 0.021, 0.033}, {-1, 0, 0}, false);
  expect_conserved(c, 1e-10);
  EXPECT_LT(motion_of(c.t, 0).momentum.x, 0) << "the block that was hit flies off";
}

// Requirement: so does an oblique one in which an edge meets a face and the blocks spin afterwards.
TEST(Collision, oblique_conserves) {
  Collision c({0.001, 0.11, 0.12}, {-1, -0.5, 0.25}, false);
  expect_conserved(c, 1e-10);
}

// Requirement: with joints between the tets angular momentum holds to 1e-6.
TEST(Collision, with_joints_conserves) {
  Collision c({0, 0.021, 0.033}, {-1, 0, 0}, true);
  expect_conserved(c, 1e-6);
}

// Requirement: friction between colliding blocks only takes energy, and its account closes the balance.
TEST(Collision, friction_only_takes_energy) {
  Collision c({0, 0.02, 0.03}, {-1, 0.6, 0}, false, 0.5);
  double lost = 0;
  for (int i = 0; i < 30; ++i) {
    c.fly(0.001);
    EXPECT_GE(c.t.s.ledger.contact_friction, lost);
    lost = c.t.s.ledger.contact_friction;
  }
  EXPECT_GT(lost, 1e-3 * c.energy_before);
  EXPECT_LE(c.worst_energy, 1e-3);
}

// Requirement: a collision with friction leaves the same bits on 1, 2 and 3 threads.
TEST(Collision, is_the_same_on_any_number_of_threads) {
  std::vector<double> reference;
  for (int threads : {1, 2, 3}) {
    parallel::Threads const guard(threads);
    Collision c({0, 0.02, 0.03}, {-1, 0.6, 0}, false, 0.5);
    c.t.advance(static_cast<long>(4e-3 / c.t.m.dt));
    std::vector<double> u(c.t.s.u.values.begin(), c.t.s.u.values.end());
    if (reference.empty()) reference = u;
    EXPECT_EQ(u, reference) << threads;
    EXPECT_GT(c.t.s.contact.pairs.size(), 0u);
  }
}

// Requirement: contact is felt from the first overlap on, however fast the bodies come: nothing is forgiven
// as an overlap of the start.
TEST(Collision, is_seen_in_time_at_any_speed) {
  for (double const speed : {1.0, 5.0, 12.0}) { // up to 6 % of the wave speed
    Collision c({0, 0.021, 0.033}, {-speed, 0, 0}, false);
    support::set_velocity(c.t, 0, {speed, 0, 0});
    double stored = 0;
    for (int i = 0; i < 40; ++i) {
      c.t.advance();
      for (auto const& p : c.t.s.contact.pairs) EXPECT_LE(p.energy_at_start, 0) << speed;
      stored = std::max(stored, c.t.s.contact.stored);
    }
    EXPECT_TRUE(speed < 5 || stored > 0) << speed;
  }
}

// Requirement: two prongs of one sound body that are driven together feel each other.
TEST(Collision, of_one_body_with_itself) {
  auto c = support::box_case({1, 1, 1}, {1, 1, 1}, 1);
  c.concretes = {support::soft_material("soft", {})};
  c.mesh.boxes = {support::box_of_cells("foot", {0, 0, 0}, {0.1, 0.1, 0.3}, {2, 2, 6}),
                  support::box_of_cells("low", {0.1, 0, 0}, {0.5, 0.1, 0.1}, {8, 2, 2}),
                  support::box_of_cells("high", {0.1, 0, 0.2}, {0.5, 0.1, 0.3}, {8, 2, 2})};
  Stepper t(c);
  support::set_velocity(t, 1, {0, 0, 20});
  support::set_velocity(t, 2, {0, 0, -20});
  double stored = 0;
  for (int i = 0; i < 200; ++i) {
    t.advance();
    stored = std::max(stored, t.s.contact.stored);
  }
  EXPECT_GT(stored, 0);
}

/// A block of concrete flies at a held one and breaks to pieces.
model::Case shattering() {
  auto c = support::box_case({1, 1, 1}, {1, 1, 1}, 1);
  c.run.joint_inertia = model::JointInertia::off;
  auto wall = support::plain_concrete(), block = wall;
  wall.name = "wall", wall.groups = {"wall"}, wall.crackable = false;
  block.name = "block", block.groups = {"block"}, block.G_f = 20;
  c.concretes = {wall, block};
  c.mesh.boxes = {support::block_of("wall", {0, 0, 0}, {0.1, 0.2, 0.2}, {1, 2, 2}),
                  support::block_of("block", {0.1005, 0.05, 0.03}, {0.2505, 0.15, 0.13}, {6, 4, 4})};
  c.supports = {support::support_at("held", support::plane(0, 0), {true, true, true})};
  return c;
}

// Requirement: while a block shatters on a wall and its fragments hit each other, the ledger closes within
// 1e-3 of the energy of the impact, and the kinetic energy never exceeds what there was at the start.
TEST(Collision, shattering_creates_no_energy) {
  Stepper t(shattering());
  support::set_velocity(t, 1, {-20, 1, 2});
  double const energy = motion_of(t).kinetic;
  double worst = 0;
  for (int i = 0; i < 700; ++i) {
    t.advance(9);
    auto const& e = t.read();
    EXPECT_LE(e.kinetic, energy * (1 + 1e-3));
    worst = std::max(worst, std::abs(energy + e.work() - e.held() - e.dissipated()) / energy);
  }
  EXPECT_LE(worst, 1e-3);
  EXPECT_GT(concrete::count_joints(t.m, t.s).released, 10);
}

} // namespace
} // namespace fissura
