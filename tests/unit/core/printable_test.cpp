#include <gtest/gtest.h>

#include "fissura/core/printable.hpp"

namespace fissura::core {
namespace {

// Requirement: what a terminal would obey is shown by its number; what it would show stays, in any script.
TEST(Printable, ShowsWhatATerminalWouldObey) {
  EXPECT_EQ(printable("\x1b[2J\x1b]0;x\x07 r\b\r"), "\\x1b[2J\\x1b]0;x\\x07 r\\x08\\x0d");
  EXPECT_EQ(printable("Tr\xc3\xa4ger \xe6\xa2\x81 \xf0\x9f\x8f\x97 %"),
            "Tr\xc3\xa4ger \xe6\xa2\x81 \xf0\x9f\x8f\x97 %");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\x9b31m"); // the control sequence of Latin-1
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\u202eb"); // turns the direction of writing
  EXPECT_EQ(printable(std::string_view("a\0b\x7f", 4)), "a\\x00b\\x7f");
}

// Requirement: bytes that are no UTF-8 are shown one by one, too: a terminal may take them for something
// else.
TEST(Printable, ShowsBytesThatAreNoText) {
  EXPECT_EQ(printable("\x9b"
                      "31m"),
            "\\x9b31m");
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xc3"), "\\xc3");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");          // too long for its number
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80"); // half of a pair
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
}

// Requirement: a text keeps its lines; a name within a line does not make new ones.
TEST(Printable, KeepsLinesOfATextOnly) {
  EXPECT_EQ(printable("a\n\tb"), "a\n\tb");
  EXPECT_EQ(printable_line("a\n\tb"), "a\\x0a\\x09b");
}

} // namespace
} // namespace fissura::core
