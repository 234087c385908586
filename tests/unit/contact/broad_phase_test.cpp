#include <gtest/gtest.h>

#include <limits>

#include "fissura/contact/broad_phase.hpp"
#include "fissura/parallel/parallel.hpp"
#include "support/random_mesh.hpp"

namespace fissura::contact {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

std::vector<Box> random_boxes(std::uint64_t seed, int count, double space, int large) {
  support::Random random(seed);
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i) {
    Vec3 const at = random.vector(-space, space);
    Vec3 const size = random.vector(0.05, 0.15) * (i < large ? 20.0 : 1.0);
    boxes.push_back({at, at + size});
  }
  return boxes;
}

Pairs by_trying_all(std::vector<Box> const& boxes) {
  Pairs pairs;
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    for (int k = i + 1; k < static_cast<int>(boxes.size()); ++k)
      if (meet(boxes[i], boxes[k])) pairs.push_back({i, k});
  return pairs;
}

// Requirement: the grid finds exactly the pairs that meet, each once and in ascending order, also with some
// boxes twenty times larger than the rest and with all boxes in one cell.
TEST(BroadPhase, finds_what_trying_all_finds) {
  for (double const space : {0.01, 0.3, 2.0, 1e6})
    for (int const large : {0, 3}) {
      auto const boxes = random_boxes(7, 600, space, large);
      auto const expected = by_trying_all(boxes);
      EXPECT_EQ(meeting_boxes(boxes), expected) << space << " " << large;
      if (space < 1e6) {
        EXPECT_FALSE(expected.empty());
      }
    }
  EXPECT_TRUE(meeting_boxes({}).empty());
  EXPECT_TRUE(meeting_boxes({Box{{0, 0, 0}, {1, 1, 1}}}).empty());
}

// Requirement: boxes that are no numbers, or without end, do no harm: the others' pairs are found all the
// same.
TEST(BroadPhase, bears_boxes_that_are_not_finite) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  auto boxes = random_boxes(9, 200, 0.3, 0);
  auto const expected = by_trying_all(boxes);
  boxes.push_back({{nan, 0, 0}, {nan, 1, 1}});
  boxes.push_back({{nan, nan, nan}, {nan, nan, nan}});
  EXPECT_EQ(meeting_boxes(boxes), expected);
  boxes.push_back({{-inf, -inf, -inf}, {inf, inf, inf}});
  EXPECT_EQ(meeting_boxes(boxes), by_trying_all(boxes));
}

// Requirement: the list does not depend on the number of threads.
TEST(BroadPhase, is_the_same_on_any_number_of_threads) {
  auto const boxes = random_boxes(3, 5000, 1.0, 2);
  parallel::Threads const one(1);
  auto const reference = meeting_boxes(boxes);
  parallel::Threads const three(3);
  EXPECT_EQ(meeting_boxes(boxes), reference);
}

} // namespace
} // namespace fissura::contact
