// What is saved comes back, and nothing is forgotten.
#include <gtest/gtest.h>

#include <random>

#include "fissura/checkpoint/archive.hpp"
#include "fissura/core/error.hpp"
#include "unit/checkpoint/state_at_random.hpp"

namespace fissura::checkpoint {
namespace {

using testing::Bytes;

// Requirement: a state in which every field of every struct has a value of its own comes back with the same
// bits, so no field is forgotten.
TEST(Archive, brings_back_every_field) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    state::State const s = testing::state_at_random(seed);
    Bytes saved;
    Saver{saved}(s);
    state::State t = testing::state_at_random(0);
    t.contact.pairs.clear(), t.rigid.touch.resize(1); // these lists grow and shrink as the run goes
    Loader load(saved.text, "file");
    load(t);
    load.finish();
    Bytes again;
    Saver{again}(t);
    EXPECT_TRUE(again.text == saved.text);
    EXPECT_EQ(t.step, s.step);
    EXPECT_EQ(t.time, s.time);
    EXPECT_EQ(t.u(2, 1), s.u(2, 1));
    EXPECT_EQ(t.v(3, 2), s.v(3, 2));
    EXPECT_EQ(t.joint_status[3], s.joint_status[3]);
    EXPECT_EQ(t.joint_history.lane[5], s.joint_history.lane[5]);
    EXPECT_EQ(t.joint_history.rows[0].of(5).last[1].sliding_2,
              s.joint_history.rows[0].of(5).last[1].sliding_2);
    EXPECT_EQ(t.joint_rate[2].excess, s.joint_rate[2].excess);
    EXPECT_EQ(t.bars.history[1].steel.direction, s.bars.history[1].steel.direction);
    EXPECT_EQ(t.bars.history[2].bond.curve.s_0, s.bars.history[2].bond.curve.s_0);
    EXPECT_EQ(t.contact.pairs.back().stretch, s.contact.pairs.back().stretch);
    EXPECT_EQ(t.rigid.touch.back().offset, s.rigid.touch.back().offset);
    EXPECT_EQ(t.paths[1].toward, s.paths[1].toward);
    EXPECT_EQ(t.ledger.absolute_work, s.ledger.absolute_work);
  }
}

// Requirement: the state at rest takes little room: of histories only those that somebody has are written.
TEST(Archive, leaves_out_histories_that_are_all_zero) {
  state::State s;
  s.joint_history.rows = core::Buffer<state::HistoryRows>(10000);
  state::JointHistory history;
  history.dissipated.friction = -0.0; // a sign is a bit too
  s.joint_history.rows[5000].set(3, history);
  Bytes saved;
  Saver{saved}(s);
  EXPECT_LT(saved.text.size(), 4000u);
  state::State t;
  t.joint_history.rows = core::Buffer<state::HistoryRows>(10000);
  Loader load(saved.text, "file");
  load(t);
  EXPECT_TRUE(std::signbit(t.joint_history.rows[5000].of(3).dissipated.friction));
}

// Requirement: a state for another model is refused by its lengths, whichever list it is.
TEST(Archive, refuses_other_lengths) {
  Bytes saved;
  Saver{saved}(testing::state_at_random(1));
  auto t = testing::state_at_random(1);
  t.u = core::NodeField(t.u.nodes() + 32);
  EXPECT_THROW(Loader(saved.text, "file")(t), core::InputError);
  t = testing::state_at_random(1);
  t.bars.account.pop_back();
  EXPECT_THROW(Loader(saved.text, "file")(t), core::InputError);
  t = testing::state_at_random(1);
  t.paths.emplace_back();
  EXPECT_THROW(Loader(saved.text, "file")(t), core::InputError);
}

// Requirement: bytes that end too early, wherever it is, or have others behind them are refused; nothing is
// allocated that they could not fill.
TEST(Archive, refuses_what_is_too_short_or_too_long) {
  Bytes saved;
  Saver{saved}(testing::state_at_random(1));
  for (std::size_t size = 0; size < saved.text.size(); size += 1 + size / 40) {
    auto t = testing::state_at_random(2);
    EXPECT_THROW(Loader(std::string_view(saved.text).substr(0, size), "file")(t), core::InputError) << size;
  }
  auto t = testing::state_at_random(2);
  saved.text += "x";
  Loader load(saved.text, "file");
  load(t);
  EXPECT_THROW(load.finish(), core::InputError);
}

/// What is said about bytes that should be a T.
template <class T> std::string refusal(std::string const& bytes, T x) {
  try {
    Loader load(bytes, "file");
    load(x);
    load.finish();
  } catch (core::InputError const& e) {
    return e.what();
  }
  return "accepted";
}

// Requirement: whatever does not fit is refused with the reason.
TEST(Archive, says_why) {
  Bytes number, list;
  Saver{number}(std::uint64_t{1} << 40U);
  Saver{list}(std::vector<double>{1, 2});
  std::string const why = "file: error: this checkpoint cannot be used: ";
  EXPECT_EQ(refusal("1234", 0.0), why + "it ends too early");
  EXPECT_EQ(refusal(number.text + "x", std::uint64_t{0}), why + "1 bytes are left over");
  EXPECT_EQ(refusal(number.text, std::string()), why + "it ends within a list");
  EXPECT_EQ(refusal(list.text, std::vector<double>{1, 2}), "accepted");
  EXPECT_EQ(refusal(list.text, std::vector<double>{1, 2, 3}), why + "a list of 2 items should have 3");
  EXPECT_EQ(refusal("\2", false), why + "a yes or no is neither");

  Bytes pairs, rows;
  Saver{pairs}(std::uint64_t{30}, std::string(40, 'x')); // fewer bytes than so many pairs take
  EXPECT_EQ(refusal(pairs.text, std::vector<state::ContactPair>()), why + "it ends within a list");
  Saver{rows}(std::uint64_t{4}, std::uint64_t{1},
              std::uint64_t{4}); // of 4 rows one is not zero, the one with index 4
  EXPECT_EQ(refusal(rows.text, core::Buffer<state::HistoryRows>(4)), why + "an index is out of its range");
}

// Requirement: bytes at random never do more than be refused.
TEST(Archive, survives_bytes_at_random) {
  std::mt19937 random(7);
  Bytes saved;
  Saver{saved}(testing::state_at_random(1));
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = saved.text;
    for (int k = 0; k < 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    auto t = testing::state_at_random(2);
    try {
      Loader(bytes, "file")(t);
    } catch (core::InputError const& e) {
      EXPECT_NE(std::string(e.what()).find("cannot be used"), std::string::npos);
    }
  }
}

} // namespace
} // namespace fissura::checkpoint
