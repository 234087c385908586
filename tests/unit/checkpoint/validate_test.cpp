// A checkpoint whose bytes are whole may still say what cannot be.
#include "fissura/checkpoint/validate.hpp"

#include <gtest/gtest.h>

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

} // namespace
} // namespace fissura::checkpoint
