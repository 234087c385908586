#include "fissura/model/shared_rows.hpp"

#include <gtest/gtest.h>

namespace fissura::model {
namespace {

// Requirement: every item finds its own values, and blocks with the same values share one set of rows.
TEST(SharedRows, keep_every_value_and_share_equal_blocks) {
  auto const values = [](std::size_t i) {
    double const kind = i < 24 ? 1 : i < 44 ? 2 : 1; // the block from 40 to 47 is mixed
    return std::array<double, 2>{kind, 10 * kind};
  };
  SharedRows<2, 8> const rows(64, values);
  for (std::size_t i = 0; i < 64; ++i)
    for (int c = 0; c < 2; ++c) EXPECT_EQ(rows(i, c), values(i)[static_cast<std::size_t>(c)]) << i;
  EXPECT_EQ(rows.of_block(0), rows.of_block(1));
  EXPECT_EQ(rows.of_block(0), rows.of_block(7)); // alike, with others between
  EXPECT_NE(rows.of_block(2), rows.of_block(3));
  EXPECT_NE(rows.of_block(5), rows.of_block(4));
}

} // namespace
} // namespace fissura::model
