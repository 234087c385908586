#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "bar_model.hpp"
#include "fissura/parallel/parallel.hpp"

namespace fissura::test {
namespace {

Mat3 rotation(Vec3 axis, double angle) {
  Vec3 const n = unit(axis);
  Mat3 const k{{Vec3{0, -n.z, n.y}, Vec3{n.z, 0, -n.x}, Vec3{-n.y, n.x, 0}}};
  return Mat3::identity() + std::sin(angle) * k + (1 - std::cos(angle)) * (k * k);
}

/// A small random affine motion of each tet on its own, so that all joints open and slide, on top of a
/// rotation.
std::function<Vec3(int, Vec3)> random_motion(std::uint64_t seed, double amount,
                                             Mat3 turn = Mat3::identity()) {
  return [=](int tet, Vec3 x) {
    support::Random random(seed + 1000 * static_cast<std::uint64_t>(tet));
    Vec3 const shift = random.vector(-amount, amount);
    Mat3 const strain{
        {random.vector(-amount, amount), random.vector(-amount, amount), random.vector(-amount, amount)}};
    return turn * (x + shift + strain * x) - x;
  };
}

std::vector<model::BarSpec> bars_across(double length) {
  auto skew = bar_along({{0.02, 0.3, 0.27}, {length - 0.03, 0.41, 0.62}});
  auto kinked = bar_along({{0.1, 0.1, 0.1}, {0.5, 0.6, 0.5}, {0.9, 0.2, 0.7}});
  skew.name = "skew", kinked.name = "kinked";
  return {skew, kinked};
}

// Force and moment of elements and joints together vanish to 1e-12, intact, cracked and yielded, also after a
// large turn.
TEST(BarForces, ForceAndMomentAreConserved) {
  for (double amount : {1e-7, 1e-5, 1e-3, 5e-3})
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      BarModel b(support::random_box_mesh(seed, {4, 3, 3}), bars_across(1));
      b.move(random_motion(seed, amount));
      b.move(random_motion(seed + 1, amount, rotation({1, 2, -1}, 0.7)));
      auto const r = b.resultant();
      ASSERT_GT(r.size, 0);
      EXPECT_LT(norm(r.force), 1e-12 * r.size) << amount;
      EXPECT_LT(norm(r.moment), 1e-12 * r.size) << amount;
    }
}

/// Why the laws of a bar's joints, or the workspace of its forces, cannot be made.
std::string refusal(auto const& action) {
  try {
    action();
  } catch (core::Error const& e) {
    return e.what();
  }
  return "accepted";
}

// A bar whose steel cannot be is refused at its place in the deck, by name; forces without laws, or without
// room for them, are errors of the program that it names.
TEST(BarForces, WhatTheyNeed) {
  BarModel b(two_tets(0.1), {bar_along({{-0.04, 0.01, 0}, {0.04, 0.01, 0}})});
  b.m.bars.properties[0].steel.f_u = 0;
  EXPECT_NE(
      refusal([&] {
        rebar::set_bar_joint_laws(b.m);
      }).find("case.toml:7:1: error: bar 'bar': steel: the tensile strength f_u must not be less than f_y"),
      std::string::npos)
      << refusal([&] { rebar::set_bar_joint_laws(b.m); });
  b.m.bars.joint_law.clear();
  EXPECT_EQ(refusal([&] { rebar::make_bar_scratch(b.m, b.w.overlay); }),
            "bar joints have no laws yet: set_bar_joint_laws comes first");
  BarModel const sound(two_tets(0.1), {bar_along({{-0.04, 0.01, 0}, {0.04, 0.01, 0}})});
  EXPECT_EQ(refusal([&] { rebar::make_bar_scratch(sound.m, state::Overlay(model::block, {})); }),
            "tet 0 holds a bar but no overlay slot");
}

// A rigid motion of the whole causes no force and holds no energy.
TEST(BarForces, RigidMotionIsFree) {
  BarModel b(support::random_box_mesh(2, {4, 3, 3}), bars_across(1));
  for (double angle : {0.5, 1.0, 2.0, 3.0}) {
    Mat3 const turn = rotation({1, 2, -1}, angle);
    b.move([&](int, Vec3 x) { return turn * x + Vec3{0.3, -0.2, 0.1} - x; });
    EXPECT_LT(b.resultant().size, 1e-10 * 210e9 * std::numbers::pi * 1e-4);
    EXPECT_LT(b.booked(), 1e-12);
  }
}

// An opened joint with dowel force that is then turned with its surroundings keeps its forces, turned.
TEST(BarForces, ForcesTurnWithTheStructure) {
  BarModel b(two_tets(0.1, 0.3), {bar_along({{-0.04, 0.01, 0.0}, {0.04, 0.01, 0.005}})});
  auto const opened = [](int tet, Vec3 x) { return tet == 0 ? Vec3{} : Vec3{1e-4, 5e-5, -3e-5} + 1e-4 * x; };
  for (int n = 1; n <= 50; ++n) b.move([&](int t, Vec3 x) { return 0.02 * n * opened(t, x); });
  auto const before = b.w.overlay.force;
  Mat3 const turn = rotation({0.3, -1, 0.5}, 1.1);
  b.move([&](int t, Vec3 x) { return turn * (x + opened(t, x)) - x; });
  double const size = b.resultant().size;
  ASSERT_GT(b.s.bars.dowel_force[0], 1);
  for (std::size_t i = 0; i < before.size(); i += 3) {
    Vec3 const expected = turn * Vec3{before[i], before[i + 1], before[i + 2]};
    Vec3 const got{b.w.overlay.force[i], b.w.overlay.force[i + 1], b.w.overlay.force[i + 2]};
    EXPECT_LT(norm(got - expected), 1e-9 * size);
  }
}

// Before cracking the bar carries E_s/E_c times the traction that the joint's parabola gives along the bar.
TEST(BarJoint, IntactJointFollowsTheConcrete) {
  BarModel b(two_tets(0.1), {bar_along({{-0.03, 0, 0}, {0.03, 0, 0}})});
  ASSERT_EQ(b.m.bars.joints.size(), 1u);
  auto const law = b.m.joints.law(0);
  for (double x : {0.1, 0.5, 0.99, -0.5}) {
    b.move([&](int tet, Vec3) { return tet == b.m.bars.joints[0].tet_b ? Vec3{x * law.o_p, 0, 0} : Vec3{}; });
    double const parabola = x < 0 ? 2 * x : 2 * x - x * x;
    EXPECT_NEAR(b.s.bars.joint_stress[0], 210.0 / 30.5 * 3e6 * parabola, 1e-6 * 3e6) << x;
    EXPECT_FALSE(b.s.bars.is_activated(0));
  }
}

// A joint starts to slip when the face it crosses opens beyond o_p, with a stress that does not jump.
TEST(BarJoint, ActivationByOpeningIsContinuous) {
  BarModel b(two_tets(0.1), {bar_along({{-0.03, 0, 0}, {0.03, 0, 0}})});
  auto const law = b.m.joints.law(0);
  auto const opened = [&](double o) {
    b.move([&](int tet, Vec3) { return tet == b.m.bars.joints[0].tet_b ? Vec3{o, 0, 0} : Vec3{}; });
    return b.s.bars.joint_stress[0];
  };
  for (int n = 1; n < 1000; ++n) opened(law.o_p * n / 1000);
  double const before = opened(law.o_p * 0.9999);
  EXPECT_FALSE(b.s.bars.is_activated(0));
  double const after = opened(law.o_p * 1.0001);
  EXPECT_TRUE(b.s.bars.is_activated(0));
  EXPECT_NEAR(after, before, 1e-3 * before);
  EXPECT_NEAR(b.s.bars.slip[0], 0.0001 * law.o_p, 1e-6 * law.o_p);
}

// A joint starts to slip also by sliding under pressure, later than without pressure (Mohr-Coulomb).
TEST(BarJoint, ActivationBySlidingUnderPressure) {
  for (double pressure : {0.0, 10e6}) {
    BarModel b(two_tets(0.1), {bar_along({{-0.03, 0, 0}, {0.03, 0, 0}})});
    auto const law = b.m.joints.law(0);
    double const s_p = (law.f_s + law.tan_phi * pressure) / law.k;
    auto const slid = [&](double s) {
      b.move([&](int tet, Vec3) {
        return tet == b.m.bars.joints[0].tet_b ? Vec3{-pressure / law.k, s, 0} : Vec3{};
      });
      return b.s.bars.is_activated(0);
    };
    EXPECT_FALSE(slid(0.999 * s_p));
    EXPECT_TRUE(slid(1.001 * s_p));
    EXPECT_LE(b.s.bars.history[0].bond.sigma_cr, 0);
  }
}

// Where the concrete cannot crack the bar joint stays linear for ever.
TEST(BarJoint, UncrackableConcreteKeepsTheJointLinear) {
  auto concrete = table_4_concrete();
  concrete.crackable = false;
  BarModel b(two_tets(0.1), {bar_along({{-0.03, 0, 0}, {0.03, 0, 0}})}, {}, concrete);
  auto const stress_at = [&](double o) {
    b.move([&](int tet, Vec3) { return tet == b.m.bars.joints[0].tet_b ? Vec3{o, 0, 0} : Vec3{}; });
    return b.s.bars.joint_stress[0];
  };
  double const one = stress_at(1e-6);
  EXPECT_NEAR(one, 210.0 / 30.5 * b.m.joints.law(0).k * 1e-6, 1e-6 * one);
  EXPECT_NEAR(stress_at(1e-4), 100 * one, 1e-6 * 100 * one);
  EXPECT_FALSE(b.s.bars.is_activated(0));
}

// Between two activated joints an element's force is the mean of theirs; the option `elastic` keeps its own
// stiffness.
TEST(BarForces, ElementBetweenCracksFollowsItsEnds) {
  for (auto between : {model::BarBetweenCracks::slip_only, model::BarBetweenCracks::elastic}) {
    model::BarSettings settings;
    settings.between_cracks = between;
    BarModel b(kuhn_box({5, 1, 1}, {1, 0.2, 0.2}), {bar_along({{0, 0.11, 0.07}, {1, 0.11, 0.07}})}, settings);
    for (int n = 1; n <= 100; ++n)
      b.move([&](int tet, Vec3 x) { return Vec3{n * 1e-6 * (tet + 100.0 * x.x), 0, 0}; });
    int between_cracks = 0;
    for (std::size_t i = 0; i < b.m.bars.elements.size(); ++i) {
      auto const& e = b.m.bars.elements[i];
      double const own = 210e9 * b.s.bars.elongation[i] / e.length;
      bool const cracked = e.joint0 >= 0 && e.joint1 >= 0 &&
                           b.s.bars.is_activated(static_cast<std::size_t>(e.joint0)) &&
                           b.s.bars.is_activated(static_cast<std::size_t>(e.joint1));
      if (between == model::BarBetweenCracks::elastic) {
        EXPECT_NEAR(b.s.bars.element_stress[i], own, 1e-9 * std::abs(own));
      } else if (cracked) {
        ++between_cracks;
        double const mean = 0.5 * (b.s.bars.joint_stress[static_cast<std::size_t>(e.joint0)] +
                                   b.s.bars.joint_stress[static_cast<std::size_t>(e.joint1)]);
        EXPECT_NEAR(b.s.bars.element_stress[i], mean, 1e-9 * std::abs(mean));
      }
    }
    EXPECT_EQ(between_cracks > 0, between == model::BarBetweenCracks::slip_only);
  }
}

// An initial strain stresses elements and intact joints alike and presses the concrete together.
TEST(BarForces, InitialStrainActsFromTheStart) {
  auto bar = bar_along({{0, 0.11, 0.07}, {1, 0.11, 0.07}});
  bar.initial_strain = 1e-3;
  BarModel b(kuhn_box({5, 1, 1}, {1, 0.2, 0.2}), {bar});
  b.move([](int, Vec3) { return Vec3{}; });
  for (double s : b.s.bars.element_stress) EXPECT_NEAR(s, 210e6, 1);
  for (double s : b.s.bars.joint_stress) EXPECT_NEAR(s, 210e6, 1);
  EXPECT_NEAR(b.energy().elements, 0.5 * 210e6 * 1e-3 * std::numbers::pi * 1e-4, 1e-9);
  EXPECT_EQ(b.energy().joints, 0);
  // Only the two ends of the bar load the concrete: the bar pulls them inwards.
  double left = 0, right = 0;
  for (std::size_t slot = 0; slot < b.w.overlay.tets.size(); ++slot)
    for (int c = 0; c < 4; ++c)
      (slot < b.w.overlay.tets.size() / 2 ? left : right) += b.w.overlay.at(static_cast<int>(slot))[3 * c];
  EXPECT_NEAR(left + right, 0, 1e-6);
}

// The forces are the same bits on one and on two threads.
TEST(BarForces, SameBitsOnAnyNumberOfThreads) {
  auto bar = bar_along({{0, 0.011, 0.3}, {1, 0.021, 0.6}});
  bar.count = 60;
  bar.spacing = {0, 0.0153, 0};
  std::vector<double> reference;
  for (int count : {1, 2}) {
    parallel::Threads const threads(count);
    BarModel b(support::random_box_mesh(5, {8, 6, 6}), {bar});
    b.move(random_motion(1, 1e-5));
    b.move(random_motion(2, 1e-4));
    if (reference.empty()) reference = b.w.overlay.force;
    EXPECT_EQ(b.w.overlay.force, reference);
  }
}

/// Largest eigenvalue of D^-1 K by power iteration; K applied by central differences of the bar forces, each
/// from the state `start`.
double largest_eigenvalue(BarModel& b, state::BarState const& start, std::vector<double> const& diagonal) {
  std::size_t const n = b.s.u.values.size();
  support::Random random(7);
  std::vector<double> x(n), y(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = diagonal[i / 3] > 0 ? random.uniform(-1, 1) : 0;
  double eigenvalue = 0;
  for (int iteration = 0; iteration < 200; ++iteration) {
    std::fill(y.begin(), y.end(), 0.0);
    double size = 0;
    for (double v : x) size = std::max(size, std::abs(v));
    for (double sign : {1.0, -1.0}) {
      double const step = sign * 1e-10 / size;
      for (std::size_t i = 0; i < n; ++i) b.s.u.values[i] = step * x[i];
      b.s.bars = start;
      b.forces();
      for (std::size_t slot = 0; slot < b.w.overlay.tets.size(); ++slot)
        for (std::size_t k = 0; k < 12; ++k)
          y[12 * static_cast<std::size_t>(b.w.overlay.tets[slot]) + k] -=
              b.w.overlay.force[12 * slot + k] / (2 * step);
    }
    double xy = 0, xx = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (diagonal[i / 3] <= 0) continue;
      xy += x[i] * y[i];
      xx += x[i] * x[i] * diagonal[i / 3];
      y[i] /= diagonal[i / 3];
    }
    eigenvalue = xy / xx;
    x = y;
  }
  return eigenvalue;
}

// The bars' share in the stable step bounds the true tangent, intact and activated, and is not far too large.
TEST(BarForces, StiffnessBoundHolds) {
  for (std::uint64_t seed = 0; seed < 6; ++seed)
    for (bool activated : {false, true}) {
      auto mesh = seed == 0 ? kuhn_box({4, 3, 3}, {1, 1, 1}) : support::random_box_mesh(seed, {4, 3, 3});
      BarModel b(std::move(mesh), bars_across(1));
      std::vector<double> k(4 * b.m.mesh.tets.size(), 0);
      rebar::add_bar_stiffness(b.m.bars, k);
      if (activated)
        for (std::size_t i = 0; i < b.m.bars.joints.size(); ++i)
          laws::activate(b.m.bars.joint_law[i].activated, b.s.bars.history[i], 0, {}, 0, 0);
      double const eigenvalue = largest_eigenvalue(b, b.s.bars, k);
      EXPECT_LE(eigenvalue, 2.0 * (1 + 1e-6)) << "seed " << seed << " activated " << activated;
      if (!activated) {
        EXPECT_GE(eigenvalue, 0.5) << "seed " << seed;
      }
    }
}

// Requirement: a bar joint that has given back more than it ever took is no negative loss that closes the
// balance, and does not hide what others have lost.
TEST(BarJoint, EnergyFromNowhereIsNotBooked) {
  BarModel b(support::random_box_mesh(0, {4, 3, 3}), bars_across(1));
  ASSERT_GE(b.s.bars.account.size(), 2u);
  b.s.bars.account[0].bond_steel = 3;
  b.s.bars.account[1].bond_steel = -1;
  EXPECT_EQ(b.energy().bond_steel, 3);
}

} // namespace
} // namespace fissura::test
