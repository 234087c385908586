// The history that a restart goes on with: which rows are taken, under which columns, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "fissura/core/error.hpp"
#include "fissura/sim/old_history.hpp"
#include "support/refusal.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::sim {
namespace {

using output::Column;
using output::testing::TemporaryFolder;

std::string const header = "time [s],u [m],\"a, b [N]\",n [-]\n", rows = "0,1.25,2,3\n0.5,4,5e-300,6\n";
std::vector<Column> const columns{{"u", "m"}, {"a, b", "N"}, {"n", "-"}};
HistoryMark const mark{header.size() + rows.size(), 2, header};

class Old : public testing::Test {
 protected:
  OldHistory read(std::string const& text, std::vector<Column> const& wanted = columns,
                  std::vector<bool> is_new = {}) const {
    std::ofstream(folder / "history.csv") << text;
    is_new.resize(wanted.size(), false);
    return read_old_history(folder / "history.csv", mark, wanted, is_new);
  }
  void expect_refused(std::string const& text, std::string const& reason) const {
    std::string const said = support::refusal(core::Failure::input, [&] { read(text); });
    EXPECT_EQ(said, folder / "history.csv: error: the run cannot go on with this file: " + reason);
  }
  TemporaryFolder const folder;
};

// Requirement: with the same columns the rows up to the mark are taken as they are, and nothing is to be
// written anew.
TEST_F(Old, rows_are_taken_up_to_the_mark) {
  auto const old = read(header + rows + "1,7,8,9\n2,");
  EXPECT_EQ(old.rows, (std::vector<double>{0, 1.25, 2, 3, 0.5, 4, 5e-300, 6}));
  EXPECT_EQ(old.bytes, mark.bytes);
  EXPECT_EQ(old.text, "");
}

// Requirement: columns that stay keep their digits, those that go leave, those that come or mean something
// else read nan.
TEST_F(Old, columns_are_found_by_their_titles) {
  std::vector<Column> const wanted{{"n", "-"}, {"new", "m"}, {"u", "m"}, {"a, b", "N"}};
  auto const old = read(header + rows, wanted, {false, true, true, false});
  EXPECT_EQ(old.text, "time [s],n [-],new [m],u [m],\"a, b [N]\"\n0,3,nan,nan,2\n0.5,6,nan,nan,5e-300\n");
  EXPECT_EQ(old.bytes, old.text.size());
  EXPECT_EQ(old.column_count, 5U);
  ASSERT_EQ(old.rows.size(), 10U);
  EXPECT_TRUE(std::isnan(old.rows[2]));
  EXPECT_EQ(old.rows[9], 5e-300);
}

// Requirement: a file that has the wanted columns already, of a restart that was killed, is cut at the row.
TEST_F(Old, file_of_a_killed_restart_is_cut_at_its_row) {
  std::vector<Column> const wanted{{"new", "m"}};
  auto const old = read("time [s],new [m]\n0,nan\n0.5,nan\n1,7\n", wanted, {true});
  EXPECT_EQ(old.text, "time [s],new [m]\n0,nan\n0.5,nan\n");
  EXPECT_EQ(
      support::refusal(core::Failure::input, [&] { read("time [s],new [m]\n0,nan\n", wanted, {true}); }),
      folder / "history.csv: error: the run cannot go on with this file: it is shorter than when the "
               "checkpoint was written");
}

// Requirement: what is not the file that was there is refused with the reason.
TEST_F(Old, file_that_is_another_is_refused) {
  expect_refused("", "its columns are others than when the checkpoint was written");
  expect_refused("t" + header.substr(1, 3) + "\n" + rows,
                 "its columns are others than when the checkpoint was written");
  expect_refused(header + rows.substr(0, rows.size() - 1),
                 "it is shorter than when the checkpoint was written");
  expect_refused(header + rows.substr(0, rows.size() - 1) + "6\n",
                 "no line ends where the checkpoint was written");
  expect_refused(header + "0,1.25,2;3\n0.5,4,5e-300,6\n", "a row has too few or too many values");
  expect_refused(header + "0,1.25,2,x\n0.5,4,5e-300,6\n", "a row has too few or too many values");
  expect_refused(header + "0,1,2,3\n0,1,2,3\n0,1,2,30\n\n", "a row has too few or too many values");
  std::string three = "0,1,2,3\n1,1,2,3\n2,1,2,";
  three += std::string(rows.size() - three.size() - 1, '3') + "\n";
  expect_refused(header + three, "it has more or fewer rows than when the checkpoint was written");
  std::remove((folder / "history.csv").c_str());
  EXPECT_EQ(support::refusal(core::Failure::io,
                             [&] {
                               read_old_history(folder / "history.csv", mark, columns, {false, false, false});
                             }),
            "cannot open '" + folder / "history.csv': No such file or directory");
}

} // namespace
} // namespace fissura::sim
