#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

#include "fissura/core/error.hpp"
#include "fissura/output/csv.hpp"
#include "support/refusal.hpp"
#include "support/unprivileged.hpp"
#include "temporary_folder.hpp"

namespace fissura::output {
namespace {

using testing::read_bytes;
using testing::TemporaryFolder;

// Requirement: the header names every column with its unit, and names with commas, quotes or line breaks are
// quoted.
TEST(Csv, HeaderHasUnitsAndQuotes) {
  TemporaryFolder folder;
  CsvWriter csv(folder / "h.csv", {{"load", "N"}, {"damage", "-"}, {"a,b", "m"}, {"the \"top\"\nbar", "Pa"}});
  csv.close();
  EXPECT_EQ(read_bytes(folder / "h.csv"),
            "time [s],load [N],damage [-],\"a,b [m]\",\"the \"\"top\"\"\nbar [Pa]\"\n");
}

// Requirement: each row is in the file as soon as it is written, so that a running job can be watched.
TEST(Csv, RowsAppearAtOnce) {
  TemporaryFolder folder;
  CsvWriter csv(folder / "h.csv", {{"load", "N"}});
  csv.row(0, std::vector{1.5});
  EXPECT_EQ(read_bytes(folder / "h.csv"), "time [s],load [N]\n0,1.5\n");
  csv.row(0.25, std::vector{-2e-9});
  EXPECT_EQ(read_bytes(folder / "h.csv"), "time [s],load [N]\n0,1.5\n0.25,-2e-09\n");
}

// Requirement: every double reads back as the same bits, and no more digits are written than that needs.
TEST(Csv, DoublesRoundTrip) {
  TemporaryFolder folder;
  std::vector<double> const values{0.1,   1.0 / 3, 6.02214076e23, 5e-324, std::numeric_limits<double>::max(),
                                   -1e-5, 1e22,    123456789.125, -0.0,   std::nextafter(1.0, 2.0)};
  std::vector<Column> const columns(values.size(), Column{"v", "-"});
  CsvWriter csv(folder / "h.csv", columns);
  csv.row(0.30000000000000004, values);
  csv.close();
  std::istringstream lines(read_bytes(folder / "h.csv"));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  EXPECT_EQ(line.substr(0, 24), "0.30000000000000004,0.1,");
  std::istringstream fields(line);
  std::string field;
  std::getline(fields, field, ',');
  for (double const expected : values) {
    ASSERT_TRUE(std::getline(fields, field, ','));
    double const read = std::strtod(field.c_str(), nullptr);
    EXPECT_EQ(read, expected);
    EXPECT_EQ(std::signbit(read), std::signbit(expected));
  }
}

// Requirement: a row of the wrong length is refused and nothing of it reaches the file.
TEST(Csv, RefusesRowsOfWrongLength) {
  TemporaryFolder folder;
  CsvWriter csv(folder / "h.csv", {{"load", "N"}});
  try {
    csv.row(0, std::vector{1.0, 2.0});
    ADD_FAILURE();
  } catch (core::Error const& e) {
    EXPECT_EQ(std::string(e.what()), "'" + folder / "h.csv' has 1 columns, the row has 2");
  }
  csv.close();
  EXPECT_EQ(read_bytes(folder / "h.csv"), "time [s],load [N]\n");
}

// Requirement: writing after close() is an I/O failure, not silence.
TEST(Csv, RowAfterCloseFails) {
  TemporaryFolder folder;
  CsvWriter csv(folder / "h.csv", {});
  csv.close();
  EXPECT_THROW(csv.row(0, {}), core::Error);
}

// Requirement: a file is gone on with after so many bytes; what is behind them is cut off.
TEST(Csv, goes_on_with_a_file) {
  TemporaryFolder const folder;
  std::vector<Column> const columns{{"a", "m"}};
  std::uint64_t kept = 0;
  {
    CsvWriter csv(folder / "h.csv", columns);
    csv.row(0, std::vector<double>{1});
    csv.flush();
    kept = csv.bytes();
    csv.row(1, std::vector<double>{2});
    csv.close();
  }
  CsvWriter csv(folder / "h.csv", columns, kept);
  csv.row(3, std::vector<double>{4});
  EXPECT_EQ(csv.bytes(), std::filesystem::file_size(folder / "h.csv"));
  csv.close();
  EXPECT_EQ(read_bytes(folder / "h.csv"), "time [s],a [m]\n0,1\n3,4\n");
}

// Requirement: a file that is shorter, has other columns or no line that ends there is refused with the
// reason, and stays as it was.
TEST(Csv, refuses_to_go_on_with_another_file) {
  TemporaryFolder const folder;
  std::string const text = "time [s],a [m]\n0,1\n";
  auto reason = [&](char const* column, std::uint64_t bytes) -> std::string {
    std::ofstream(folder / "h.csv") << text;
    try {
      CsvWriter(folder / "h.csv", {{column, "m"}}, bytes);
    } catch (core::InputError const& e) {
      EXPECT_EQ(read_bytes(folder / "h.csv"), text);
      return e.what();
    }
    return "not refused";
  };
  EXPECT_NE(reason("a", 30).find("shorter"), std::string::npos);
  EXPECT_NE(reason("b", 19).find("columns"), std::string::npos);
  EXPECT_NE(reason("a", 18).find("no line ends"), std::string::npos);
  EXPECT_EQ(reason("a", 19), "not refused");
}

/// What an I/O failure says.
std::string io_error(auto const& action) {
  return support::refusal(core::Failure::io, action);
}

// Requirement: a file to go on with that is gone, or may only be read, is an I/O failure with path and
// reason.
TEST(Csv, CannotGoOnWithoutTheFile) {
  TemporaryFolder const folder;
  std::string const path = folder / "h.csv";
  EXPECT_EQ(io_error([&] { CsvWriter(path, {}, 9); }),
            "cannot open '" + path + "': No such file or directory");
  CsvWriter(path, {}).close();
  std::filesystem::permissions(folder.name(), std::filesystem::perms(0755));
  std::filesystem::permissions(path, std::filesystem::perms(0444));
  support::Unprivileged const nobody;
  if (!nobody.is()) GTEST_SKIP() << "root stays root here";
  EXPECT_EQ(io_error([&] { CsvWriter(path, {}, 9); }), "cannot open '" + path + "': Permission denied");
}

// Requirement: a flush that the system refuses is an I/O failure: a null device takes rows and keeps nothing.
TEST(Csv, FlushFails) {
  CsvWriter csv("/dev/null", {});
  csv.row(0, {});
  EXPECT_EQ(io_error([&] { csv.flush(); }), "cannot flush '/dev/null': Invalid argument");
}

} // namespace
} // namespace fissura::output
