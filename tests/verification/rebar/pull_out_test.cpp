// Energy of a bar across one crack between two tets: the work put in through the corners equals what is held
// and lost, on paths that load, unload, reload, slide and tear.
#include <gtest/gtest.h>

#include "../../unit/rebar/bar_model.hpp"

namespace fissura::test {
namespace {

/// How far tet b has moved away from tet a, and the strain of both.
struct Station {
  Vec3 apart;        ///< [m]
  double strain = 0; ///< along x, of both tets
  double shear = 0;  ///< of both tets: y moves with x
};

struct Balance {
  double largest_error = 0; ///< of work - booked along the path [J]
  double largest = 0;       ///< of the work [J]
};

/// Walks straight from station to station in `steps` steps each, on from where the bar is.
Balance walk(BarModel& b, std::vector<Station> const& stations, int steps, Station from = {}) {
  Balance balance;
  int const side_b = b.m.bars.joints[0].tet_b;
  double const start = b.booked() - b.work;
  for (auto const& to : stations) {
    for (int n = 1; n <= steps; ++n) {
      double const t = static_cast<double>(n) / steps;
      Vec3 const apart = (1 - t) * from.apart + t * to.apart;
      double const strain = (1 - t) * from.strain + t * to.strain;
      double const shear = (1 - t) * from.shear + t * to.shear;
      b.move([&](int tet, Vec3 x) {
        return Vec3{strain * x.x, shear * x.x, 0} + (tet == side_b ? apart : Vec3{});
      });
      balance.largest_error = std::max(balance.largest_error, std::abs(b.work - (b.booked() - start)));
      balance.largest = std::max(balance.largest, std::abs(b.work));
    }
    from = to;
  }
  return balance;
}

BarModel two_tet_bar(model::BarBetweenCracks between, double tilt = 0, double initial_strain = 0) {
  model::BarSettings settings;
  settings.between_cracks = between;
  auto bar = bar_along({{-0.04, 0.002, 0.001}, {0.05, 0.002, 0.001}});
  bar.initial_strain = initial_strain;
  return BarModel(two_tets(0.1, tilt), {bar}, settings);
}

constexpr auto slip_only = model::BarBetweenCracks::slip_only;
constexpr auto elastic = model::BarBetweenCracks::elastic;

std::vector<Station> const cycles{{{1e-4, 0, 0}, 2e-4}, {{0, 0, 0}, 1e-4},    {{3e-4, 0, 0}, 5e-4},
                                  {{-2e-5, 0, 0}, 0},   {{5e-4, 0, 0}, 1e-3}, {{3e-4, 0, 0}, 2e-4},
                                  {{6e-4, 0, 0}, 8e-4}, {{0, 0, 0}, 0}};

// Load, unload, reload past yield and back along the bar: work = held + lost within 0.1 %, with both element
// options.
TEST(PullOut, AxialCyclesBalance) {
  for (auto between : {slip_only, elastic}) {
    auto b = two_tet_bar(between);
    auto const balance = walk(b, cycles, 2000);
    EXPECT_TRUE(b.s.bars.has_yielded(0));
    EXPECT_FALSE(b.s.bars.is_broken(0));
    EXPECT_LT(balance.largest_error, 1e-3 * balance.largest);
    EXPECT_GT(b.energy().bond_steel, 0);
  }
}

// The same with prestress: the energy held from the start is part of the balance.
TEST(PullOut, PrestressedCyclesBalance) {
  for (auto between : {slip_only, elastic}) {
    auto b = two_tet_bar(between, 0, 1e-3);
    b.move([](int, Vec3) { return Vec3{}; });
    b.work = 0;
    auto const balance = walk(b, cycles, 2000);
    EXPECT_LT(balance.largest_error, 1e-3 * balance.largest);
  }
}

// Opening and sliding of an oblique crack with dowel action, there and back: the balance holds within 0.5 %.
TEST(PullOut, ObliqueCyclesBalance) {
  for (auto between : {slip_only, elastic}) {
    auto b = two_tet_bar(between, 0.6);
    auto const balance = walk(b,
                              {{{1e-4, 5e-5, 2e-5}, 1e-4},
                               {{1e-5, 0, 0}, 0},
                               {{5e-4, 4e-4, -2e-4}, 3e-4},
                               {{2e-4, -3e-4, 2e-4}, 1e-4},
                               {{7e-4, 5e-4, 5e-4}, 5e-4},
                               {{0, 0, 0}, 0}},
                              2000);
    EXPECT_FALSE(b.s.bars.is_broken(0));
    EXPECT_GT(b.energy().dowel, 0);
    EXPECT_LT(balance.largest_error, 5e-3 * balance.largest);
  }
}

// Across a crack whose faces have slid by 2 D, the hosts shear to and fro while the bar is pulled and
// released, a quarter of a period apart: over ten cycles no energy comes out of it, and the balance holds
// within 1 %.
TEST(PullOut, HostsThatShearBesideAWideCrackGainNothing) {
  auto b = two_tet_bar(slip_only);
  walk(b, {{{1e-4, 0.03, 0}, 0}}, 20000);
  ASSERT_FALSE(b.s.bars.is_broken(0));
  double const before = b.work;
  std::vector<Station> cycle;
  Vec3 const wide{1e-4, 0.03, 0}, pulled{1.3e-4, 0.03, 0};
  for (int i = 0; i < 10; ++i)
    for (Station const& s : {Station{wide, 0, 1e-3}, {pulled, 0, 1e-3}, {pulled, 0, -1e-3}, {wide, 0, -1e-3}})
      cycle.push_back(s);
  auto const balance = walk(b, cycle, 200, {wide});
  EXPECT_GE(b.work, before);
  EXPECT_LT(balance.largest_error, 1e-2 * balance.largest);
}

// Pulled until it tears, the bar holds nothing any more, and what it held is in the account `rupture`.
TEST(PullOut, RuptureBalances) {
  for (auto between : {slip_only, elastic}) {
    auto b = two_tet_bar(between);
    auto const balance = walk(b, {{{2e-2, 0, 0}, 1e-3}}, 20000);
    ASSERT_TRUE(b.s.bars.is_broken(0));
    EXPECT_EQ(b.s.bars.joint_stress[0], 0);
    EXPECT_EQ(b.energy().joints, 0);
    EXPECT_LT(balance.largest_error, 1e-3 * balance.largest);
  }
}

// Cut by sliding while it is still pulled, the bar releases at once what it held, into the account `rupture`.
TEST(PullOut, CutByShearReleasesItsEnergy) {
  auto b = two_tet_bar(slip_only);
  walk(b, {{{3e-4, 0, 0}, 5e-4}}, 2000);
  double const held = b.energy().joints;
  auto const balance = walk(b, {{{3e-4, 0.13, 0}, 5e-4}}, 20000, {{3e-4, 0, 0}, 5e-4});
  ASSERT_TRUE(b.s.bars.is_broken(0));
  EXPECT_GT(b.energy().rupture, 0.3 * held);
  EXPECT_EQ(b.energy().joints, 0);
  EXPECT_LT(balance.largest_error, 1e-2 * balance.largest);
}

// The books do not jump at activation, when the joint takes over the halves of its elements.
TEST(PullOut, ActivationDoesNotJump) {
  for (auto between : {slip_only, elastic}) {
    auto b = two_tet_bar(between);
    double const o_p = b.m.joints.law(0).o_p;
    auto const balance = walk(b, {{{2 * o_p, 0, 0}, 2e-5}}, 4000);
    ASSERT_TRUE(b.s.bars.is_activated(0));
    EXPECT_GT(b.s.bars.history[0].stored_0, 0);
    EXPECT_LT(balance.largest_error, 1e-4 * balance.largest);
  }
}

} // namespace
} // namespace fissura::test
