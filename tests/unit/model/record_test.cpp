#include "fissura/model/record.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "fissura/core/error.hpp"
#include "support/unprivileged.hpp"

namespace fissura::model {
namespace {

using Baseline = RecordSpec::Baseline;

Record parsed(std::string_view text, RecordSpec const& spec = {}) {
  return parse_record(text, "quake.txt", spec);
}

// Requirement: comments and headers are skipped, numbers may be parted by spaces, commas or semicolons, times
// count from the first row, and values come out in SI.
TEST(Record, reads_rows_among_headers_and_comments) {
  RecordSpec spec;
  spec.unit = 9.80665;
  auto const r = parsed("Station 12, comp. NS\r\ntime [s], a [g]\r\n# made\r\n 1.0, 0.1\r\n\r\n1.5;+0.2\r\n% "
                        "note\r\n2.5\t-3e-1 extra\r\n",
                        spec);
  EXPECT_EQ(r.times, (std::vector<double>{0, 0.5, 1.5}));
  EXPECT_EQ(r.acceleration, (std::vector<double>{0.1 * 9.80665, 0.2 * 9.80665, -0.3 * 9.80665}));
}

// Requirement: columns are chosen by number; without times the rows are evenly spaced, and without columns
// all numbers of all rows are taken in turn (the way PEER writes its records).
TEST(Record, reads_columns_and_blocks_of_numbers) {
  RecordSpec columns;
  columns.time_column = 3, columns.acceleration_column = 1;
  EXPECT_EQ(parsed("5 x 0\n6 x 1\n", columns).acceleration, (std::vector<double>{5, 6}));
  RecordSpec single;
  single.time_column = 0, single.acceleration_column = 2, single.time_step = 0.5;
  EXPECT_EQ(parsed("0 1\n0 2\n0 3\n", single).times, (std::vector<double>{0, 0.5, 1}));
  RecordSpec block;
  block.time_column = block.acceleration_column = 0, block.time_step = 0.01;
  auto const r = parsed("PEER NGA\nNPTS= 7, DT= .01 SEC\n .1E-1 2. 3.\n 4. 5. 6.\n 7.\n", block);
  EXPECT_EQ(r.acceleration, (std::vector<double>{0.01, 2, 3, 4, 5, 6, 7}));
  EXPECT_DOUBLE_EQ(r.times.back(), 0.06);
}

/// Where and what the reading complains of.
std::string complaint(std::string_view text, RecordSpec const& spec = {}) {
  try {
    parsed(text, spec);
  } catch (core::InputError const& e) {
    return core::to_string(e.diagnostics.front().place) + ": " + e.diagnostics.front().message;
  }
  return "none";
}

// Requirement: what is wrong in a file is named with its line and column.
TEST(Record, names_the_place_of_an_error) {
  auto begins = [](std::string const& text, std::string const& with) {
    EXPECT_EQ(text.substr(0, with.size()), with) << text;
  };
  begins(complaint("0 1\n1 2\n1 3\n"),
         "quake.txt:3:1: the times must increase from row to row: 1 s after 1 s");
  begins(complaint("0 1\n1 two\n"),
         "quake.txt:2:3: `two` is not a finite number; the record needs a time in column 1");
  begins(complaint("0 1\n1 nan\n"), "quake.txt:2:3: `nan` is not a finite number");
  begins(complaint("0 1\n1 1e999\n"), "quake.txt:2:3: `1e999` is not a finite number");
  begins(complaint("0 1\n1\n"), "quake.txt:2:1: this row has 1 numbers");
  begins(complaint("0 1\n"), "quake.txt: the record needs at least two rows");
  begins(complaint(""), "quake.txt: the record needs at least two rows");
  begins(complaint(std::string_view("0 1\n\0 2\n", 8)), "quake.txt: the record is not a text file");
  std::string prose;
  for (int i = 0; i < 300; ++i) prose += "no numbers here\n";
  begins(complaint(prose), "quake.txt:201:1: no row of numbers in the first 200 lines");
}

/// A decaying sine with an offset, a drift and uneven rows.
Record wave(double offset, double drift) {
  Record r;
  for (int i = 0; i <= 400; ++i) {
    double const t = 0.01 * i + 0.004 * (i % 3 == 1);
    r.times.push_back(t);
    r.acceleration.push_back(std::exp(-0.5 * t) * std::sin(9 * t) + offset + drift * t);
  }
  return r;
}

// Requirement: velocity and displacement are the exact integrals of the broken line: twice the displacement
// curve's slope change over a short interval is the acceleration, at and between rows.
TEST(Record, integrates_exactly) {
  Record r;
  r.times = {0, 1, 3};
  r.acceleration = {0, 6, -6};
  correct_and_integrate(r, {});
  EXPECT_EQ(r.velocity, (std::vector<double>{0, 3, 3}));
  // u = t^3 up to 1 s; then 1 + 3 x + 3 x^2 - x^3, x = t - 1
  EXPECT_DOUBLE_EQ(r.displacement[1], 1);
  EXPECT_DOUBLE_EQ(r.displacement[2], 1 + 6 + 12 - 8);
}

// Requirement: each baseline leaves no velocity at the end and less mean square of it the higher its degree;
// a line in the acceleration is taken out by `linear` whole.
TEST(Record, takes_the_baseline_out) {
  double before = 1e300;
  for (Baseline const b : {Baseline::mean, Baseline::linear, Baseline::quadratic}) {
    auto r = wave(0.2, -0.05);
    RecordSpec spec;
    spec.baseline = b;
    correct_and_integrate(r, spec);
    double square = 0, largest = 0;
    for (double const v : r.velocity) square += v * v, largest = std::max(largest, std::abs(v));
    EXPECT_NEAR(r.velocity.back(), 0, 1e-12);
    EXPECT_LT(square, before);
    EXPECT_LT(largest, 0.3);
    before = square;
  }
  RecordSpec linear;
  linear.baseline = Baseline::linear;
  auto clean = wave(0, 0), shifted = wave(0.2, -0.05);
  correct_and_integrate(clean, linear);
  correct_and_integrate(shifted, linear);
  for (std::size_t i = 0; i < clean.times.size(); ++i)
    EXPECT_NEAR(clean.acceleration[i], shifted.acceleration[i], 1e-12);
}

// Requirement: without a baseline the record stays as it is; scaling makes the largest acceleration the PGA.
TEST(Record, is_scaled_to_its_pga) {
  auto r = wave(0.2, 0);
  auto const as_read = r.acceleration;
  correct_and_integrate(r, {});
  EXPECT_EQ(r.acceleration, as_read);
  RecordSpec spec;
  spec.pga = 3;
  correct_and_integrate(r, spec);
  double largest = 0;
  for (double const a : r.acceleration) largest = std::max(largest, std::abs(a));
  EXPECT_DOUBLE_EQ(largest, 3);
  Record zero;
  zero.times = {0, 1}, zero.acceleration = {0, 0};
  EXPECT_THROW(correct_and_integrate(zero, spec), core::InputError);
}

// Requirement: a record that may not be read is an input/output failure that names it.
TEST(Record, that_may_not_be_read) {
  auto const path = std::filesystem::temp_directory_path() / ("fissura_secret_" + std::to_string(::getpid()));
  std::ofstream(path) << "0 0\n1 0\n";
  std::filesystem::permissions(path, std::filesystem::perms(0));
  RecordSpec spec;
  spec.file = path.string();
  std::string said = "accepted";
  bool skipped = false;
  try {
    support::Unprivileged const nobody;
    skipped = !nobody.is();
    read_record(spec);
  } catch (core::Error const& e) {
    EXPECT_EQ(e.failure, core::Failure::io);
    said = e.what();
  }
  std::filesystem::remove(path);
  if (skipped) GTEST_SKIP() << "root stays root here";
  EXPECT_EQ(said, "cannot read the record \"" + spec.file + "\"");
}

// Requirement: a file that is not there or that is huge is refused by name.
TEST(Record, refuses_files_that_are_not_there) {
  RecordSpec spec;
  spec.place = {"case.toml", 12, 3};
  spec.file = "/nowhere/quake.txt";
  try {
    read_record(spec);
    FAIL();
  } catch (core::InputError const& e) {
    EXPECT_STREQ(e.what(), "case.toml:12:3: error: there is no record \"/nowhere/quake.txt\"");
  }
  auto const huge = std::filesystem::temp_directory_path() / ("fissura_huge_" + std::to_string(::getpid()));
  std::ofstream(huge) << "0 0\n1 0\n";
  std::filesystem::resize_file(huge, (64U << 20U) + 1); // takes no room on the disk
  spec.file = huge.string();
  try {
    read_record(spec);
    ADD_FAILURE();
  } catch (core::InputError const& e) {
    EXPECT_EQ(std::string(e.what()), spec.file + ": error: the record is larger than 64 MiB");
  }
  std::filesystem::remove(huge);
}

// Requirement: so is one with more values than any quake has, before they fill the memory.
TEST(Record, refuses_more_values_than_fit) {
  RecordSpec spec;
  spec.time_step = 0.01, spec.time_column = 0, spec.acceleration_column = 0;
  std::string text;
  for (int i = 0; i < 5000001; ++i) text += "0\n";
  try {
    parsed(text, spec);
    ADD_FAILURE();
  } catch (core::InputError const& e) {
    EXPECT_NE(
        std::string(e.what()).find("quake.txt:5000001:1: error: the record has more than 5000000 values"),
        std::string::npos)
        << e.what();
  }
}

// Requirement: a file is read from the disk as its text would be, and gives a curve that starts when it is
// told to.
TEST(Record, gives_a_curve_of_displacements) {
  auto const file = std::filesystem::temp_directory_path() / ("fissura_record_" + std::to_string(::getpid()));
  std::ofstream(file) << "0 0\n1 2\n2 0\n";
  RecordSpec spec;
  spec.file = file.string(), spec.unit = 3;
  auto const r = read_record(spec);
  std::filesystem::remove(file);
  auto const c = displacement_curve(r, 10);
  EXPECT_EQ(c.times, (std::vector<double>{10, 11, 12}));
  EXPECT_DOUBLE_EQ(c.values[1], 1); // a ramp of 6 m/s3: 6/6
  EXPECT_DOUBLE_EQ(c.slopes[1], 3);
  EXPECT_DOUBLE_EQ(c.slopes[2], 6);
}

} // namespace
} // namespace fissura::model
