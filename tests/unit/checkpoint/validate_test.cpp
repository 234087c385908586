// A checkpoint whose bytes are whole may still say what cannot be.
#include "fissura/checkpoint/validate.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "fissura/core/error.hpp"
#include "support/concrete_model.hpp"

namespace fissura::checkpoint {
namespace {

using state::JointStatus;

struct Damaged {
  model::Model m = support::concrete_model(support::box_mesh({2, 1, 1}, {0.2, 0.1, 0.1}));
  state::State s = support::concrete_state(m);

  Damaged() {
    set_status(s, 0, JointStatus::damaged), s.joint_history.lane[0] = 0;
    set_status(s, 1, JointStatus::broken), s.joint_history.lane[1] = 1;
    set_status(s, 2, JointStatus::released);
    s.joint_history.lane[2] = static_cast<std::uint8_t>(s.joint_history.room(0) - 1);
  }
  std::string refusal() const {
    try {
      validate(m, s, Loader({}, "file"));
      return "";
    } catch (core::InputError const& e) {
      return e.what();
    }
  }
};

// Requirement: damaged joints have the first lanes of their group and released ones the last, each its own; a
// checkpoint that says otherwise is refused, for two joints would change one history.
TEST(ValidateCheckpoint, refuses_lanes_that_do_not_fit) {
  Damaged x;
  EXPECT_EQ(x.refusal(), "");
  for (auto const& [joint, lane] : {std::pair{1, 0}, {1, 2}, {0, 255}, {2, 2}, {2, 255}}) {
    Damaged y;
    y.s.joint_history.lane[static_cast<std::size_t>(joint)] = static_cast<std::uint8_t>(lane);
    EXPECT_NE(y.refusal().find("histories of joints do not fit their status"), std::string::npos)
        << joint << " in " << lane;
  }
}

// Requirement: a status, a stage and a time that do not exist are refused.
TEST(ValidateCheckpoint, refuses_what_does_not_exist) {
  Damaged status, stage, time;
  status.s.joint_status[0] = 5;
  EXPECT_NE(status.refusal().find("a joint has an unknown status"), std::string::npos);
  stage.s.stage = static_cast<int>(stage.m.stages.size());
  EXPECT_NE(stage.refusal().find("there is no such stage"), std::string::npos);
  time.s.step = -1;
  EXPECT_NE(time.refusal().find("the time is no time"), std::string::npos);
}

model::Model small_model() {
  model::Model m;
  m.tets.count = 4;
  m.rigid.resize(2), m.paths.resize(1), m.stages.resize(3);
  m.paths[0].targets.resize(2);
  return m;
}

/// A state that fits: two pairs of tets in contact, two points in touch, a path on its way.
state::State sound_state() {
  state::State s;
  s.contact.pairs.resize(2), s.rigid.touch.resize(2), s.paths.resize(1);
  s.contact.pairs[0].a = 0, s.contact.pairs[0].b = 2;
  s.contact.pairs[1].a = 1, s.contact.pairs[1].b = 2;
  s.rigid.touch[0].tet = 0, s.rigid.touch[1].tet = 3;
  s.paths[0].target = -1;
  return s;
}

/// What is said of a state that has been changed.
std::string refusal(std::function<void(state::State&)> const& change) {
  auto s = sound_state();
  change(s);
  try {
    validate(small_model(), s, Loader({}, "run/checkpoints/checkpoint_00001.bin"));
  } catch (core::InputError const& e) {
    return e.what();
  }
  return "";
}

void expect_refusal(std::function<void(state::State&)> const& change, std::string const& reason) {
  std::string const text = refusal(change);
  EXPECT_NE(text.find("checkpoint_00001.bin"), std::string::npos) << text;
  EXPECT_NE(text.find("this checkpoint cannot be used: " + reason), std::string::npos) << text;
}

// Requirement: a state that fits passes.
TEST(ValidateState, accepts_what_fits) {
  EXPECT_EQ(refusal([](state::State&) {}), "");
  EXPECT_EQ(refusal([](state::State& s) { s.paths[0].target = 2; }), ""); // beyond the last: it has ended
}

// Requirement: a time that is none and stages before the first are refused too.
TEST(ValidateState, refuses_times_and_stages_that_cannot_be) {
  expect_refusal([](state::State& s) { s.time = std::numeric_limits<double>::quiet_NaN(); },
                 "the time is no time");
  expect_refusal([](state::State& s) { s.stage = -1; }, "there is no such stage");
}

// Requirement: paths aim at one of their targets.
TEST(ValidateState, refuses_unknown_targets) {
  expect_refusal([](state::State& s) { s.paths[0].target = -2; }, "a path has no such target");
  expect_refusal([](state::State& s) { s.paths[0].target = 3; }, "a path has no such target");
}

// Requirement: a bar remembers no more branches than its history has room for, and its strain rises or falls.
TEST(ValidateState, refuses_bars_that_remember_too_much) {
  std::string const reason = "a bar remembers more branches than there is room for";
  auto const with = [](auto change) {
    return [=](state::State& s) { s.bars.history.resize(2), change(s.bars.history[1].steel); };
  };
  EXPECT_EQ(refusal(with([](laws::SteelHistory& h) { h.rising.count = laws::BranchList::capacity; })), "");
  expect_refusal(with([](laws::SteelHistory& h) { h.rising.count = laws::BranchList::capacity + 1; }),
                 reason);
  expect_refusal(with([](laws::SteelHistory& h) { h.falling.count = -1; }), reason);
  expect_refusal(with([](laws::SteelHistory& h) { h.direction = 2; }), reason);
}

// Requirement: pairs in contact name two tets of the mesh, the lower first, and lie in order, once each.
TEST(ValidateState, refuses_pairs_that_do_not_fit) {
  std::string const reason = "pairs of tets in contact do not fit the mesh";
  expect_refusal([](state::State& s) { s.contact.pairs[1].b = 4; }, reason);
  expect_refusal([](state::State& s) { s.contact.pairs[0].a = -1; }, reason);
  expect_refusal([](state::State& s) { s.contact.pairs[1].a = 2; }, reason);
  expect_refusal([](state::State& s) { std::swap(s.contact.pairs[0], s.contact.pairs[1]); }, reason);
}

// Requirement: points in touch with rigid bodies name a tet, a face, a point and a body that there are, in
// order.
TEST(ValidateState, refuses_touches_that_do_not_fit) {
  std::string const reason = "points in touch with rigid bodies do not fit the mesh";
  expect_refusal([](state::State& s) { s.rigid.touch[1].tet = 4; }, reason);
  expect_refusal([](state::State& s) { s.rigid.touch[0].face = 4; }, reason);
  expect_refusal([](state::State& s) { s.rigid.touch[0].point = 100; }, reason);
  expect_refusal([](state::State& s) { s.rigid.touch[0].body = 2; }, reason);
  expect_refusal([](state::State& s) { std::swap(s.rigid.touch[0], s.rigid.touch[1]); }, reason);
}

} // namespace
} // namespace fissura::checkpoint
