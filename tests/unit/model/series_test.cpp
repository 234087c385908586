#include "fissura/model/series.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fissura/core/error.hpp"
#include "fissura/model/record.hpp"

namespace fissura::model {
namespace {

using Values = std::vector<double>;

SeriesFormat spaced(double step) {
  SeriesFormat f;
  f.time_column = f.value_column = 0, f.time_step = step;
  return f;
}

Series parsed(std::string const& text, SeriesFormat const& format = {}) {
  return parse_series(text, "u.txt", format);
}

std::string complaint(std::string const& text, SeriesFormat const& format = {}) {
  try {
    parsed(text, format);
  } catch (core::InputError const& e) {
    return e.what();
  }
  return "none";
}

/// Twelve values, a thousandth of their number each.
std::string rows() {
  std::string text;
  for (int i = 1; i <= 12; ++i) text += "0.0" + std::to_string(10 + i) + (i % 4 == 0 ? "\n" : " ");
  return text;
}

SeriesHeader header_of(std::string_view line) {
  SeriesHeader h;
  read_header_line(line, h);
  return h;
}

// Requirement: step, count and unit are found in the headers of the usual data banks.
TEST(SeriesHeader, is_read) {
  auto h = header_of("NPTS=   4000, DT=   .0050 SEC,");
  EXPECT_EQ(h.count, 4000);
  EXPECT_EQ(h.step, 0.005);
  h = header_of("SOME STATION  CHANNEL 1  401 POINTS AT .010 SEC, CM/S/S");
  EXPECT_EQ(h.count, 401);
  EXPECT_EQ(h.step, 0.01);
  EXPECT_EQ(h.unit, "cm/s2");
  h = header_of("2000 points of accel data equally spaced at  .020 sec, in cm/sec2. (units: cm/sec2)");
  EXPECT_EQ(h.count, 2000);
  EXPECT_EQ(h.step, 0.02);
  EXPECT_EQ(h.unit, "cm/s2");
  EXPECT_EQ(header_of("Sampling Freq(Hz) 100Hz").step, 0.01);
  EXPECT_EQ(header_of("# dt = 5 ms, npts: 77").step, 0.005);
  EXPECT_EQ(header_of("ACCELERATION TIME SERIES IN UNITS OF G").unit, "g");
  EXPECT_EQ(header_of("SOME QUAKE, 3/11/1999, SOME STATION, 090").step, 0);
  EXPECT_EQ(header_of("12:45 EDT, 7 POINTSMAN").count, 0);
}

// Requirement: a first row that counts the values behind it, alone or with their step, is a header in
// whatever layout, and said to be one.
TEST(Series, takes_a_counting_row_for_a_header) {
  for (auto const* first : {"12\n", "12 0.01\n", "0.01 12\n"}) {
    auto const s = parsed(first + rows(), spaced(0.01));
    EXPECT_EQ(s.values.size(), 12U) << first;
    EXPECT_EQ(s.values.front(), 0.011) << first;
    ASSERT_EQ(s.notes.size(), 1U) << first;
    EXPECT_NE(s.notes[0].find("is taken for a header, not for values"), std::string::npos) << s.notes[0];
    EXPECT_TRUE(s.warnings.empty()) << first;
  }
  std::string timed = "11 0.5\n";
  for (int i = 0; i < 11; ++i) timed += std::to_string(i) + " 7\n";
  EXPECT_EQ(parsed(timed).times.size(), 11U);
  EXPECT_EQ(parsed("13\n" + rows(), spaced(0.01)).values.front(), 13); // counts nothing
}

// Requirement: a step or a count in the header that contradicts deck or rows is a warning with both values.
TEST(Series, names_both_sides_of_a_contradiction) {
  auto const warning = [](std::string const& text, SeriesFormat const& f) {
    auto const s = parsed(text, f);
    return s.warnings.empty() ? std::string("none") : s.warnings.front();
  };
  EXPECT_EQ(
      warning("NPTS= 12, DT= .0100 SEC\n" + rows(), spaced(0.005)),
      "u.txt: the header names a step of 0.01 s, but `time_step` of the deck is 0.005 s: one of them is "
      "wrong, or the time is scaled on purpose");
  EXPECT_EQ(
      warning("dt = 0.5\n0 1\n1 2\n2 3\n", {}),
      "u.txt: the header names a step of 0.5 s, but its rows follow each other after 1 s: one of them is "
      "wrong, or the time is scaled on purpose");
  EXPECT_EQ(warning("NPTS= 20\n" + rows(), spaced(0.01)),
            "u.txt: the header names 20 values, but 12 are there: is the file cut off?");
  EXPECT_EQ(warning("12 0.02\n" + rows(), spaced(0.01)),
            "u.txt: the header names a step of 0.02 s, but `time_step` of the deck is 0.01 s: one of them is "
            "wrong, or the time is scaled on purpose");
  EXPECT_EQ(warning("NPTS= 12, DT= .0100 SEC\n" + rows(), spaced(0.01)), "none");
}

// Requirement: where the deck says neither columns nor a step, that of the header holds, unless the first
// column holds just these times.
TEST(Series, follows_the_header_where_the_deck_says_nothing) {
  SeriesFormat f;
  f.as_header_says = true;
  auto const block = parsed("NPTS= 12, DT= .5 SEC\n" + rows(), f);
  EXPECT_EQ(block.values.size(), 12U);
  EXPECT_EQ(block.times[3], 1.5);
  EXPECT_NE(block.notes.at(0).find("the step is that of the header"), std::string::npos);
  auto const timed = parsed("# dt = 0.1 s\n0.0 5\n0.1 6\n0.2 7\n", f);
  EXPECT_EQ(timed.values, (Values{5, 6, 7}));
  EXPECT_EQ(timed.times, (Values{0, 0.1, 0.2}));
  EXPECT_EQ(parsed("0 1\n1 2\n", f).values, (Values{1, 2}));
}

// Requirement: Fortran's exponents are read; columns that touch are parted where it is beyond doubt, else
// refused by name.
TEST(Series, reads_fixed_width) {
  EXPECT_EQ(parsed("0.0 1.5D-03\n0.1 -2.5d+1\n").values, (Values{1.5e-3, -25}));
  EXPECT_EQ(parsed("-0.123E-02-0.456E-02 1.0-783.363-773.704\n", spaced(1)).values,
            (Values{-0.123e-2, -0.456e-2, 1, -783.363, -773.704}));
  EXPECT_NE(complaint("0.5 0.6\n1.5-3 0.2\n", spaced(1))
                .find("u.txt:2:1: error: `1.5-3` is no number; if columns of a fixed width touch here"),
            std::string::npos);
  EXPECT_NE(complaint("0.5 0.6\n0.1230.456\n", spaced(1)).find("`0.1230.456` is no number"),
            std::string::npos);
}

// Requirement: decimal commas are refused by name; commas that part numbers are none.
TEST(Series, refuses_decimal_commas) {
  EXPECT_EQ(
      complaint("0,00\t0,125\n0,01\t0,25\n"),
      "u.txt:1:1: error: `0,00`: a decimal comma? Write a point; a comma that parts two numbers is followed "
      "by a blank");
  EXPECT_NE(complaint("0;0\n1;-1,5E-3\n").find("u.txt:2:3: error: `-1,5E-3`: a decimal comma?"),
            std::string::npos);
  EXPECT_NE(complaint("0,123\n-0,456\n", spaced(1)).find("`0,123`: a decimal comma?"), std::string::npos);
  EXPECT_EQ(parsed("0,1.5\n1,-2.5\n").values, (Values{1.5, -2.5}));
  EXPECT_EQ(parsed("0, 1\n1, 2\n").values, (Values{1, 2}));
  EXPECT_EQ(parsed("0,1,9\n1,2,9\n").values, (Values{1, 2}));
}

// Requirement: times at a constant step and values in a decimal unit are the doubles nearest to what is
// written, as those of a table in the deck are.
TEST(Series, is_exact) {
  auto f = spaced(0.1);
  f.unit = 1e-3;
  auto const s = parsed("0.1 0.2 0.3 0.7\n", f);
  EXPECT_EQ(s.times, (Values{0, 0.1, 0.2, 0.3}));
  EXPECT_EQ(s.values, (Values{1e-4, 2e-4, 3e-4, 7e-4}));
  EXPECT_EQ(extent_of(s.times), "4 values at a step of 0.1 s, 0.3 s");
  EXPECT_EQ(extent_of({0, 1, 3}), "3 values at steps of 1 to 2 s, 3 s");
}

// Requirement: a file of an old Mac, or one marked as UTF-8, is a file like any other.
TEST(Series, reads_all_line_ends) {
  EXPECT_EQ(parsed("\xef\xbb\xbf"
                   "0 1\r1 2\r")
                .values,
            (Values{1, 2}));
}

// ---- records

RecordSpec in_g() {
  RecordSpec spec;
  spec.unit = 9.80665;
  return spec;
}

std::vector<std::string> doubts_of(std::string const& text, RecordSpec const& spec) {
  auto r = parse_record(text, "quake.txt", spec);
  correct_and_integrate(r, spec);
  return doubts(r);
}

// Requirement: a PGA above 3 g, a base that moves by metres and a first value far above all others are warned
// of; a usual record is not.
TEST(Record, that_no_quake_gives) {
  EXPECT_TRUE(doubts_of("0 0\n1 0.3\n2 -0.3\n3 0\n", in_g()).size() == 1); // moves by metres within 3 s
  EXPECT_TRUE(doubts_of("0 0\n0.01 0.3\n0.02 -0.3\n0.03 0\n", in_g()).empty());
  auto const strong = doubts_of("0 0\n0.01 3.5\n0.02 -3\n0.03 0\n", in_g());
  ASSERT_EQ(strong.size(), 1U);
  EXPECT_EQ(strong[0], "its PGA is 3.5 g; hardly a quake has more than 3 g: is `unit` right?");
  auto const leading = doubts_of("0 2.5\n0.01 0.1\n0.02 -0.1\n0.03 0\n", in_g());
  ASSERT_EQ(leading.size(), 1U);
  EXPECT_EQ(leading[0].substr(0, 58), "its first value, 24.52 m/s2, is 25 times the largest of th");
}

// Requirement: the log names the PGA in both units, the count, the step and the duration.
TEST(Record, is_described) {
  auto r = parse_record("0 0\n0.01 0.3\n0.02 -0.25\n0.03 0\n", "quake.txt", in_g());
  correct_and_integrate(r, in_g());
  auto const text = describe(r);
  EXPECT_EQ(text.substr(0, text.find(", largest v")),
            "4 values at a step of 0.01 s, 0.03 s; PGA 0.3000 g (2.942 m/s2)");
}

// Requirement: a unit in the header that contradicts the deck is a warning with both.
TEST(Record, of_another_unit_than_its_header_says) {
  auto const r = parse_record("IN UNITS OF CM/S/S\n0 0\n1 1\n", "quake.txt", in_g());
  ASSERT_EQ(r.warnings.size(), 1U);
  EXPECT_EQ(r.warnings[0],
            "quake.txt: the header names the unit cm/s2, `unit` of the deck is 9.80665 m/s2: one "
            "of them is wrong");
  EXPECT_TRUE(parse_record("IN UNITS OF G\n0 0\n1 1\n", "quake.txt", in_g()).warnings.empty());
}

} // namespace
} // namespace fissura::model
