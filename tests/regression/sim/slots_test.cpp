// The places of joint forces after a restart are those that a run has come to step by step.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fmt/format.h>

#include "fissura/concrete/concrete.hpp"
#include "fissura/deck/deck.hpp"
#include "support/cases.hpp"

namespace fissura::support {
namespace {

/// Joints by what has become of them.
std::array<int, 5> statuses(model::Model const& m, state::State const& s) {
  std::array<int, 5> count{};
  for (int j = 0; j < m.joints.count; ++j) ++count[s.joint_status[static_cast<std::size_t>(j)]];
  return count;
}

/// Tables made from the state equal those that grew with it, entry by entry; no tet takes a force from a
/// released joint.
void expect_fresh_tables_are_equal(Stepper const& x) {
  auto const fresh = concrete::make_joint_slots(x.m, x.s);
  ASSERT_EQ(fresh.place.size(), x.w.joints.place.size());
  EXPECT_TRUE(std::equal(fresh.place.begin(), fresh.place.end(), x.w.joints.place.begin()));
  EXPECT_TRUE(std::equal(fresh.sign.begin(), fresh.sign.end(), x.w.joints.sign.begin()));
  for (int j = 0; j < x.m.joints.count; ++j) {
    if (x.s.joint_status[j] != static_cast<std::uint8_t>(state::JointStatus::released)) continue;
    auto const& face = x.m.adjacency.shared[x.m.joints.joints[j].shared_face];
    for (auto const side : {face.a, face.b})
      for (int k = 0; k < 3; ++k)
        EXPECT_EQ(fresh.place[model::at(static_cast<std::size_t>(side.tet), 3 * side.face + k, 12)],
                  static_cast<int>(fresh.zeros()));
  }
}

// Requirement: tables made from the state of a smashed beam equal those that grew with it, all the way from
// intact joints over damaged and broken ones to released ones.
TEST(JointSlots, follow_the_state) {
  Stepper x(deck::read_case(FISSURA_TEST_DATA "/../decks/smashed_beam.toml", {}));
  std::array<int, 5> seen{};
  for (int i = 0; i < 20; ++i) {
    x.advance(100);
    auto const count = statuses(x.m, x.s);
    for (std::size_t status = 0; status < count.size(); ++status) seen[status] += count[status];
    expect_fresh_tables_are_equal(x);
  }
  for (auto const status : {state::JointStatus::intact, state::JointStatus::damaged,
                            state::JointStatus::broken, state::JointStatus::released})
    EXPECT_GT(seen[static_cast<std::size_t>(status)], 0) << "status " << static_cast<int>(status);
}

// Requirement: with work arrays made anew from the state the next steps have the same bits.
TEST(JointSlots, made_anew_change_no_bit) {
  Stepper x(deck::read_case(FISSURA_TEST_DATA "/../decks/smashed_beam.toml", {}));
  Stepper y(deck::read_case(FISSURA_TEST_DATA "/../decks/smashed_beam.toml", {}));
  x.advance(1000), y.advance(1000);
  y.w = step::make_scratch(y.m, y.s);
  x.advance(50), y.advance(50);
  EXPECT_TRUE(std::equal(x.s.u.values.begin(), x.s.u.values.end(), y.s.u.values.begin()));
  EXPECT_TRUE(std::equal(x.s.v.values.begin(), x.s.v.values.end(), y.s.v.values.begin()));
}

// Requirement: the same with joint inertia, where joints that are released split points: the rows of a
// restart are those of the run, and what vanishes with the joints is booked as lost.
TEST(PointRows, made_anew_change_no_bit) {
  auto c = deck::read_case(FISSURA_TEST_DATA "/../decks/smashed_beam.toml", {});
  c.run.joint_inertia = model::JointInertia::on;
  Stepper x(c), y(c);
  int split = 0;
  for (int i = 0; i < 10; ++i) {
    double const lost = x.s.ledger.joint_inertia;
    x.advance(100), y.advance(100);
    EXPECT_GE(x.s.ledger.joint_inertia, lost);
    y.w = step::make_scratch(y.m, y.s);
    for (auto const parts : y.w.points.parts) split += parts > 1;
  }
  EXPECT_GT(split, 0);
  EXPECT_GT(x.s.ledger.joint_inertia, 0);
  x.advance(50), y.advance(50);
  EXPECT_TRUE(std::equal(x.s.u.values.begin(), x.s.u.values.end(), y.s.u.values.begin()));
  EXPECT_TRUE(std::equal(x.s.v.values.begin(), x.s.v.values.end(), y.s.v.values.begin()));
}

} // namespace
} // namespace fissura::support
