// Two runs against each other, and a run watched.
#include <gtest/gtest.h>

#include "fissura/core/error.hpp"
#include "fissura/report/compare.hpp"
#include "fissura/report/text_plot.hpp"
#include "fissura/report/watch.hpp"
#include "support/refusal.hpp"
#include "unit/report/support.hpp"

namespace fissura::report {
namespace {

using testing::TemporaryFolder;

struct TwoRuns {
  TemporaryFolder folder;
  explicit TwoRuns(double factor) {
    testing::make_running(folder / "a", 1);
    testing::make_running(folder / "b", 1, factor);
  }
  Comparison compared(double tolerance, std::vector<std::string> columns = {"load"}) const {
    return compare(RunFolder(folder / "a"), RunFolder(folder / "b"),
                   {.tolerance = tolerance, .columns = std::move(columns), .version = ""});
  }
};

// Requirement: equal runs agree with a tolerance of zero.
TEST(Compare, EqualRunsAgree) {
  auto const c = TwoRuns(1).compared(0);
  EXPECT_TRUE(c.agree);
  EXPECT_NE(c.verdict.find("1 column within 0 %"), std::string::npos);
}

// Requirement: a load that is 10 % larger everywhere differs by the mean of the curve times 10 % of its
// range.
TEST(Compare, MeasuresOverTheRange) {
  TwoRuns const runs(1.1);
  auto const c = runs.compared(0.02);
  EXPECT_FALSE(c.agree);
  ASSERT_FALSE(c.rows.empty());
  auto const& load = c.rows.front();
  EXPECT_EQ(load.name, "load");
  EXPECT_NEAR(load.largest, 0.1, 1e-9);
  EXPECT_NEAR(load.at, 0.06, 1e-9);
  double sum = 0;
  for (int i = 0; i < 100; ++i) sum += i < 60 ? 1000.0 * i : 60000.0 - 500 * (i - 60);
  EXPECT_NEAR(load.mean, 0.1 * sum / 100 / 60000, 1e-9);
  EXPECT_NEAR(load.peaks[1], 66000, 1e-6);
  EXPECT_TRUE(runs.compared(0.2).agree);
}

// Requirement: only the columns that are named decide; all are measured.
TEST(Compare, NamedColumnsDecide) {
  auto const c = TwoRuns(1.5).compared(0.01, {"sag, mid [raw]"});
  EXPECT_TRUE(c.agree);
  EXPECT_EQ(c.rows.size(), 4u);
}

// Requirement: runs that end at other times differ, whatever their curves.
TEST(Compare, EndsCount) {
  TwoRuns const runs(1);
  testing::write_text(runs.folder / "b/history.csv", testing::history_text(50));
  auto const c = runs.compared(0.02);
  EXPECT_FALSE(c.agree);
  EXPECT_NE(c.verdict.find("The runs end at t = 0.099 s and 0.049 s, and so they differ"), std::string::npos);
}

// Requirement: the range is that of the time both runs share: what the longer one does later hides nothing.
TEST(Compare, RangeOfTheSharedTime) {
  TwoRuns const runs(1);
  testing::write_text(runs.folder / "b/history.csv", testing::history_text(11, 1.1));
  auto const c = runs.compared(0.02); // up to t = 0.01 s the load grows from 0 to 10 kN, later to 60 kN
  ASSERT_FALSE(c.rows.empty());
  EXPECT_NEAR(c.rows.front().largest, 0.1, 1e-9);
  EXPECT_TRUE(c.rows.front().differs);
}

// Requirement: a column that is missing, runs without rows, and no column in common are errors of the input.
TEST(Compare, NamesWhatIsWrong) {
  TwoRuns const runs(1);
  auto const error = [&](std::vector<std::string> columns) {
    return support::refusal(core::Failure::input, [&] { runs.compared(0.02, std::move(columns)); });
  };
  EXPECT_NE(error({"laod"}).find("no column `laod`; there are: time, load"), std::string::npos);
  EXPECT_NE(error({}).find("no reading in common"), std::string::npos); // no deck, no reactions
  testing::write_text(runs.folder / "b/history.csv", "time [s],load [N]\n");
  EXPECT_NE(error({"load"}).find("history.csv has no rows yet"), std::string::npos);
}

// Requirement: the table for the terminal names the runs, each deciding column, and the verdict in its last
// line.
TEST(Compare, WritesATable) {
  TwoRuns const runs(1.1);
  auto const text =
      comparison_text(runs.compared(0.02), RunFolder(runs.folder / "a"), RunFolder(runs.folder / "b"));
  EXPECT_NE(text.find("load [N]"), std::string::npos);
  EXPECT_TRUE(text.ends_with("differ\n"));
}

// Requirement: a run in progress shows its share of the time that the log forecast, its curve and its last
// words.
TEST(Watch, ShowsHowFarARunHasCome) {
  TemporaryFolder const t;
  testing::make_running(t / "run", 1);
  RunFolder const run(t / "run");
  EXPECT_DOUBLE_EQ(planned_end(run), 0.2);
  WatchOptions options;
  options.plot.dots = false;
  auto const screen = watch_screen(run, options);
  EXPECT_NE(screen.find("49.5 %   t = 0.099 of 0.2 s"), std::string::npos) << screen;
  EXPECT_NE(screen.find("load [kN]"), std::string::npos); // 60 kN at most
  EXPECT_NE(screen.find("*"), std::string::npos);
  EXPECT_NE(screen.find("200 steps"), std::string::npos);
}

// Requirement: under pace control the forecast counts the time of the loads, and so does the share.
TEST(Watch, CountsTheTimeOfTheLoads) {
  TemporaryFolder const t;
  testing::make_running(t / "run", 1);
  testing::write_text(t / "run/history.csv", "time [s],load [N],load_time [s]\n0,0,0\n0.05,1000,0.1\n");
  auto const screen = watch_screen(RunFolder(t / "run"), {});
  EXPECT_NE(screen.find("50.0 %   t = 0.1 of 0.2 s"), std::string::npos) << screen;
}

// Requirement: a finished run says how it ended; an unknown column is an error of the input.
TEST(Watch, SaysHowARunEnded) {
  TemporaryFolder const t;
  testing::make_running(t / "run", 1);
  testing::finish(t / "run");
  RunFolder const run(t / "run");
  EXPECT_NE(watch_screen(run, {}).find("complete: end time reached"), std::string::npos);
  WatchOptions options;
  options.y = "laod";
  EXPECT_THROW(watch_screen(run, options), core::Error);
}

// Requirement: a straight line is a diagonal of stars between its ends, with the ends of both axes beside it.
TEST(TextPlot, DrawsALine) {
  std::vector<double> const x{0, 10}, y{0, 5};
  auto const text = text_plot(x, y, "u [m]", "F [N]", {.width = 3, .height = 3, .dots = false});
  EXPECT_EQ(
      text,
      "F [N]\n         5 |  *\n           | *\n         0 |*\n           +---\n            0 10 u [m]\n");
  EXPECT_EQ(text_plot(std::vector<double>{1}, std::vector<double>{1}, "x", "y", {}), "");
}

// Requirement: the bar is as long as asked and never leaves its ends.
TEST(TextPlot, DrawsABar) {
  EXPECT_EQ(progress_bar(0.5, 8), "####....");
  EXPECT_EQ(progress_bar(-1, 4), "....");
  EXPECT_EQ(progress_bar(7, 4), "####");
}

} // namespace
} // namespace fissura::report
