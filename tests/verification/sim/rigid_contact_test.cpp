// Blocks and rigid bodies that collide, slide and rest: against conservation laws and closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "fissura/parallel/parallel.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/sim/state_hash.hpp"
#include "support/cases.hpp"

namespace fissura::support {
namespace {

/// A block that stays elastic, from the origin.
model::Case elastic_block(std::array<int, 3> cells, Vec3 size) {
  auto c = box_case(cells, size, 1);
  c.concretes = {unbreakable_concrete()};
  c.concretes[0].crackable = false;
  return c;
}
model::PlaneSpec plane_through(Vec3 point, Vec3 normal, double friction) {
  return {{"case.toml", 50, 1}, "floor", point, normal, friction};
}
model::ImpactorSpec ball(Vec3 centre, double radius, double mass, Vec3 velocity, double friction) {
  model::ImpactorSpec i;
  i.place = {"case.toml", 60, 1};
  i.name = "ball";
  i.centre = centre, i.radius = radius, i.mass = mass, i.velocity = velocity, i.friction = friction;
  return i;
}
model::InitialVelocitySpec thrown(Vec3 velocity) {
  return {{"case.toml", 70, 1}, everything(), velocity};
}

Vec3 momentum(Stepper const& x) {
  Vec3 p;
  for (std::size_t n = 0; n < 4 * static_cast<std::size_t>(x.m.tets.count); ++n)
    p += x.m.mass[n] * x.s.v.at(n);
  for (std::size_t i = 0; i < x.m.rigid.size(); ++i) p += x.m.rigid[i].mass * x.s.rigid.body[i].v;
  return p;
}

/// Steps to `time` [s] with a reading every `every` steps; the largest residual met.
double run_until(Stepper& x, double time, long every = 5) {
  sim::Monitor monitor(x.m);
  while (x.s.time < time) {
    x.read();
    monitor.take(x.e, x.m, x.s);
    x.advance(every - 1);
  }
  return std::abs(monitor.residual());
}

Vec3 middle(Stepper const& x) {
  Vec3 sum;
  double mass = 0;
  for (std::size_t n = 0; n < 4 * static_cast<std::size_t>(x.m.tets.count); ++n) {
    sum += x.m.mass[n] * x.s.u.at(n);
    mass += x.m.mass[n];
  }
  return sum / mass;
}

// Requirement: an elastic block that lands flat on a frictionless plane bounces back, its energy is kept
// within 1e-3 in every reading, and the plane's impulse is its change of momentum to rounding.
TEST(RigidContact, block_that_lands_flat_bounces) {
  auto c = elastic_block({6, 6, 6}, {0.2, 0.2, 0.2});
  c.planes = {plane_through({0, 0, -1e-4}, {0, 0, 1}, 0)};
  c.initial_velocities = {thrown({0, 0, -2})};
  Stepper x(c);
  Vec3 const before = momentum(x);
  EXPECT_LE(run_until(x, 1e-3), 1e-3);
  EXPECT_TRUE(x.s.rigid.touch.empty());
  double const rebound = momentum(x).z / x.m.total_mass;
  EXPECT_GT(rebound, 1.6); // the rest of the energy rings in the block
  Vec3 const balance = before + x.s.rigid.body[0].impulse - momentum(x);
  EXPECT_LE(norm(balance), 1e-12 * norm(before));
  RecordProperty("rebound", std::to_string(rebound));
}

// Requirement: the same for a block that lands on a corner.
TEST(RigidContact, block_that_lands_on_its_corner_bounces) {
  auto c = elastic_block({4, 4, 4}, {0.2, 0.2, 0.2});
  Vec3 const n = unit(Vec3{1, 1.2, 0.9});
  c.planes = {plane_through(-1e-4 * n, n, 0)};
  c.initial_velocities = {thrown(-2 * n)};
  Stepper x(c);
  Vec3 const before = momentum(x);
  EXPECT_LE(run_until(x, 4e-3), 1e-3);
  EXPECT_TRUE(x.s.rigid.touch.empty());
  EXPECT_GT(dot(momentum(x), n), 0);
  EXPECT_LE(norm(before + x.s.rigid.body[0].impulse - momentum(x)), 1e-12 * norm(before));
}

// Requirement: a block that slides on a plane stops after v^2/(2 mu g) within 1 %, and friction has taken its
// kinetic energy. Once it has stopped it swings on its friction springs, which nothing damps, but stays where
// it is within a thousandth of the way.
TEST(RigidContact, sliding_block_stops_where_coulomb_says) {
  double const speed = 0.5, mu = 0.4, g = 9.81;
  auto c = elastic_block({2, 2, 1}, {0.4, 0.4, 0.1});
  c.planes = {plane_through({}, {0, 0, 1}, mu)};
  c.initial_velocities = {thrown({speed, 0, 0})};
  c.gravity.on = true, c.gravity.curve = constant(g);
  Stepper x(c);
  double const energy = 0.5 * x.m.total_mass * speed * speed;
  double const stop = speed / (mu * g);
  EXPECT_LE(run_until(x, 1.1 * stop, 50), 1e-2);
  double const stopped_at = middle(x).x;
  EXPECT_LE(run_until(x, 1.2 * stop, 50), 1e-2);
  EXPECT_LE(std::abs(middle(x).x - stopped_at), 1e-3 * stopped_at);
  EXPECT_NEAR(middle(x).x, speed * speed / (2 * mu * g), 0.01 * speed * speed / (2 * mu * g));
  EXPECT_NEAR(x.e.contact_friction, energy, 0.01 * energy);
  EXPECT_LE(x.e.kinetic, 1e-3 * energy);
}

// Requirement: a block on a slope of 25 degrees, below its friction angle of 31, creeps less than 1e-6 of its
// size per second once it has come to rest; on one of 35 degrees, its vibration damped, it slides with g (sin
// - mu cos).
TEST(RigidContact, block_rests_below_the_friction_angle) {
  double const pi = std::acos(-1.0), g = 9.81, size = 0.4;
  auto on_slope = [&](double degrees) {
    auto c = elastic_block({2, 2, 1}, {size, size, 0.1});
    c.planes = {plane_through({}, {0, 0, 1}, 0.6)};
    double const a = degrees * pi / 180;
    c.gravity.on = true;
    c.gravity.direction = {std::sin(a), 0, -std::cos(a)};
    c.gravity.curve = ramp(g, 5e-3);
    model::StageSpec settle, rest;
    settle.name = "settle", settle.duration = 0.02, settle.mass_damping = 2000;
    rest.name = "rest", rest.duration = 0.1;
    c.stages = {settle, rest};
    return c;
  };
  Stepper x(on_slope(25));
  run_until(x, 0.02, 50);
  x.s.stage = 1;
  x.s.stage_start[1] = x.s.time;
  Vec3 const start = middle(x);
  double const from = x.s.time;
  run_until(x, from + 0.1, 50);
  double const creep = norm(middle(x) - start) / (x.s.time - from) / size;
  EXPECT_LE(creep, 1e-6);
  EXPECT_GE(x.s.rigid.touch.size(), 8u * 7u); // all points of the 8 faces of its base, and edges of its sides
  std::printf("creep %.2e of the size per second\n", creep);

  auto steep = on_slope(35);
  steep.stages[0].mass_damping = 0;
  steep.concretes[0].mu_bar = 1e6;
  Stepper y(steep);
  run_until(y, 0.02, 50);
  double const v = momentum(y).x / y.m.total_mass, t = y.s.time;
  run_until(y, t + 0.05, 50);
  double const a = 35 * pi / 180, expected = g * (std::sin(a) - 0.6 * std::cos(a));
  EXPECT_NEAR((momentum(y).x / y.m.total_mass - v) / (y.s.time - t), expected, 0.01 * expected);
}

// Requirement: a rigid ball that strikes a free elastic block without friction and off its middle: linear
// momentum is kept to 1e-12, energy to 1e-3.
TEST(RigidContact, ball_and_block_keep_momentum_and_energy) {
  auto c = elastic_block({4, 4, 4}, {0.2, 0.2, 0.2});
  c.impactors = {ball({0.07, 0.12, 0.2511}, 0.05, 4, {0.5, -0.2, -3}, 0)};
  Stepper x(c);
  Vec3 const before = momentum(x);
  EXPECT_LE(run_until(x, 2e-3), 1e-3);
  EXPECT_GT(x.s.rigid.body[0].v.z, -3);
  EXPECT_LE(norm(momentum(x) - before), 1e-12 * norm(before));
  EXPECT_GT(norm(x.s.rigid.body[0].impulse), 1);
}

// Requirement: with friction linear momentum is still kept to 1e-12, and what the ledger loses to contact
// friction is what is missing from the energy held, within 1e-3.
TEST(RigidContact, friction_of_a_ball_is_accounted_for) {
  auto c = elastic_block({4, 4, 4}, {0.2, 0.2, 0.2});
  c.impactors = {ball({0.07, 0.12, 0.2511}, 0.05, 4, {3, -1, -3}, 0.3)};
  Stepper x(c);
  Vec3 const before = momentum(x);
  EXPECT_LE(run_until(x, 2e-3), 1e-3);
  EXPECT_LE(norm(momentum(x) - before), 1e-12 * norm(before));
  EXPECT_GT(x.e.contact_friction, 0.02 * x.e.start);
}

// Requirement: a guided box that falls on a block under gravity keeps its guide: it moves along z only, and
// its mass times its change of velocity is the weight's and the contact's impulse.
TEST(RigidContact, guided_box_moves_along_its_guide_only) {
  auto c = elastic_block({3, 3, 2}, {0.15, 0.15, 0.1});
  c.supports = {support_at("base", plane(2, 0), {true, true, true})};
  auto box = ball({}, 0, 20, {0, 0, -1}, 0.5);
  box.shape = model::ImpactorSpec::Shape::box;
  box.from = {0.03, 0.04, 0.1001}, box.to = {0.2, 0.11, 0.3};
  box.moves = {false, false, true};
  c.impactors = {box};
  c.gravity.on = true, c.gravity.curve = constant(9.81);
  Stepper x(c);
  run_until(x, 2e-3);
  auto const& b = x.s.rigid.body[0];
  EXPECT_EQ(b.u.x, 0);
  EXPECT_EQ(b.v.y, 0);
  EXPECT_LT(b.impulse.z, 0); // on the concrete: downwards
  double const weight = -20 * 9.81 * x.s.time;
  EXPECT_NEAR(20 * (b.v.z + 1), weight - b.impulse.z, 1e-12 * 20);
}

// Requirement: a cracking block that a cylinder strikes while it falls on a plane is the same to the bit on
// 1, 2 and 3 threads, in state, energies and contact forces.
TEST(RigidContact, is_the_same_on_any_number_of_threads) {
  auto c = box_case({8, 6, 6}, {0.4, 0.2, 0.2}, 1);
  c.planes = {plane_through({0, 0, -1e-5}, unit(Vec3{0.05, 0, 1}), 0.6)};
  auto rod = ball({}, 0.05, 60, {0, 0.3, -12}, 0.4);
  rod.shape = model::ImpactorSpec::Shape::cylinder;
  rod.from = {0.2, -0.1, 0.2502}, rod.to = {0.2, 0.3, 0.2502};
  c.impactors = {rod};
  c.initial_velocities = {thrown({0, 0, -5})};
  auto run = [&](int threads) {
    parallel::Threads const limit(threads);
    Stepper x(c);
    x.advance(600);
    x.read();
    return std::tuple{sim::state_hash(x.m, x.s), x.e.held(), x.e.dissipated(), x.s.rigid.body[1].v.z,
                      x.s.rigid.body[0].impulse.z};
  };
  auto const one = run(1);
  EXPECT_GT(std::get<3>(one), -12);
  EXPECT_GT(std::get<4>(one), 0);
  for (int const threads : {2, 3}) EXPECT_EQ(run(threads), one);
}

// Requirement: of a block that is crushed on a plane nothing sinks in by more than a thirtieth of a cell,
// also not concrete that is pushed out edge first between its neighbours while all its cracks are still
// closed.
TEST(RigidContact, nothing_of_a_crushed_block_sinks_in) {
  double const cell = 0.06;
  auto c = box_case({4, 4, 4}, {4 * cell, 4 * cell, 4 * cell}, 1);
  c.mesh.boxes[0].tets_per_cell = 24;
  Vec3 const n = unit(Vec3{-0.3, -0.12, 1}), corner{4 * cell, 4 * cell, 0};
  c.planes = {plane_through(corner - 1e-4 * n, n, 0.6)};
  c.initial_velocities = {thrown({0, 0, -20})};
  Stepper x(c);
  double deepest = 0;
  while (x.s.time < 1e-3) {
    x.advance(20);
    for (int i = 0; i < 4 * x.m.tets.count; ++i)
      deepest = std::max(deepest, -dot(x.m.position.at(i) + x.s.u.at(i) - x.m.rigid[0].centre, n));
  }
  std::printf("deepest %.2f mm\n", 1e3 * deepest);
  EXPECT_LE(deepest, cell / 30);
}

// Requirement: when the list of near faces is made anew in the middle of a run, as after a restart, nothing
// changes to the bit.
TEST(RigidContact, does_not_depend_on_when_faces_are_listed) {
  auto c = elastic_block({4, 4, 4}, {0.2, 0.2, 0.2});
  c.planes = {plane_through({0, 0, -1e-5}, unit(Vec3{0.05, 0.1, 1}), 0.6)};
  c.initial_velocities = {thrown({1, 0, -5})};
  Stepper a(c), b(c);
  a.advance(700);
  std::size_t touched = 0;
  for (int i = 0; i < 7; ++i) {
    b.advance(100);
    touched = std::max(touched, b.s.rigid.touch.size());
    b.w = step::make_scratch(b.m, b.s);
  }
  EXPECT_GT(touched, 0u);
  EXPECT_EQ(sim::state_hash(a.m, a.s), sim::state_hash(b.m, b.s));
}

// Requirement: what the tangential spring of a point holds when the point comes free is booked as friction.
TEST(RigidContact, a_point_that_comes_free_books_what_it_held) {
  auto c = elastic_block({1, 1, 1}, {0.1, 0.1, 0.1});
  c.contact.on = true;
  c.impactors = {ball({0.05, 0.05, 0.15001}, 0.05, 1, {}, 0.5)}; // a hundredth of a millimetre above
  Stepper x(std::move(c));
  x.advance(1);
  ASSERT_FALSE(x.w.rigid.faces.empty());
  for (double const lifted : {0.0, 10.0}) { // just free; gone faster than a face is wide
    auto const face = x.w.rigid.faces.front();
    Vec3 const stretch{3e-7, -4e-7, 0};
    x.s.rigid.touch = {{face.tet, face.face, 6, face.body, 0, stretch}};
    x.s.rigid.body[face.body].u.z += lifted;
    double const before = x.s.ledger.contact_friction;
    x.advance(1);
    double const held = face.area * 9.0 / 20 * 0.5 * 2.0 / 7 * face.stiffness * 25e-14;
    EXPECT_NEAR(x.s.ledger.contact_friction - before, held, 1e-12 * held) << lifted;
    EXPECT_TRUE(x.s.rigid.touch.empty());
  }
}

} // namespace
} // namespace fissura::support
