#include "fissura/core/number.hpp"

#include <gtest/gtest.h>

namespace fissura::core {
namespace {

// Requirement: numbers are read as Fortran, C and spreadsheets write them, to the nearest double; all else is
// none.
TEST(Number, is_read_as_other_programs_write_it) {
  EXPECT_EQ(read_decimal("+1.5"), 1.5);
  EXPECT_EQ(read_decimal("-.5"), -0.5);
  EXPECT_EQ(read_decimal("5."), 5.0);
  EXPECT_EQ(read_decimal("0.1"), 0.1);
  EXPECT_EQ(read_decimal("-3e-1"), -0.3);
  EXPECT_EQ(read_decimal("1.5D-03"), 1.5e-3);
  EXPECT_EQ(read_decimal("1.5d+3"), 1500.0);
  EXPECT_EQ(read_decimal("1e-400"), 0.0);
  for (auto const* none : {"", "+", ".", "e5", "1e", "1e+", "1.5-3", "1,5", "inf", "nan", "0x1p3", "1 2",
                           "--1", "1.2.3", "5 mm", "1e999"})
    EXPECT_FALSE(read_decimal(none)) << none;
  EXPECT_EQ(decimal_text("+1.5D+03"), "1.5e03");
}

} // namespace
} // namespace fissura::core
