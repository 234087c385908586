// Run folders read back.
#include <gtest/gtest.h>

#include "fissura/core/error.hpp"
#include "fissura/report/run_folder.hpp"
#include "support/refusal.hpp"
#include "unit/report/support.hpp"

namespace fissura::report {
namespace {

using testing::TemporaryFolder;

std::string error_of(std::string const& folder) {
  return support::refusal(core::Failure::io, [&] { RunFolder const run(folder); });
}

// Requirement: a run that goes on is read as far as it has come: a last line without its end is left out.
TEST(RunFolder, ReadsARunThatGoesOn) {
  TemporaryFolder const t;
  testing::make_running(t / "run", 3);
  RunFolder const run(t / "run");
  EXPECT_FALSE(run.finished());
  EXPECT_EQ(run.name(), "run");
  EXPECT_EQ(run.history.rows(), 100u);
  EXPECT_EQ(run.frames.at("cracks").size(), 3u);
  EXPECT_DOUBLE_EQ(run.frames.at("bars").back().time, 0.02);
  EXPECT_TRUE(run.frames.at("rigid").empty());
}

// Requirement: columns are found by name without unit, also where the name is quoted and holds commas.
TEST(RunFolder, FindsColumnsByName) {
  TemporaryFolder const t;
  testing::make_running(t / "run", 1);
  RunFolder const run(t / "run");
  ASSERT_NE(run.history.find("load"), nullptr);
  EXPECT_EQ(run.history.find("load")->unit, "N");
  EXPECT_DOUBLE_EQ(run.history.find("load")->values[30], 30000);
  ASSERT_NE(run.history.find("sag, mid [raw]"), nullptr);
  EXPECT_EQ(run.history.find("sag, mid [raw]")->unit, "m");
  EXPECT_EQ(run.history.find("nothing"), nullptr);
}

// Requirement: the log is read without dates, and lines without a date belong to the one before.
TEST(RunFolder, ReadsTheLog) {
  TemporaryFolder const t;
  testing::write_text(t / "log.txt",
                      "2026-01-31 12:00:00 warning: two\nlines\n2026-01-31 12:00:00 info: t = 1: on\n");
  auto const log = read_log(t / "log.txt");
  ASSERT_EQ(log.size(), 2u);
  EXPECT_EQ(log[0].level, "warning");
  EXPECT_EQ(log[0].text, "two\nlines");
  EXPECT_EQ(log[1].text, "t = 1: on");
}

// Requirement: a missing folder, a folder that is no run, and files that are not what they are called are
// named.
TEST(RunFolder, NamesWhatIsWrong) {
  TemporaryFolder const t;
  EXPECT_NE(error_of(t / "none").find("no such run folder"), std::string::npos);
  EXPECT_NE(error_of(t.name()).find("no run folder (it holds neither history.csv nor run.json)"),
            std::string::npos);
  testing::make_running(t / "a", 1);
  testing::write_text(t / "a/run.json", "{\"status\": ");
  EXPECT_NE(error_of(t / "a").find("run.json': no JSON object"), std::string::npos);
  testing::make_running(t / "b", 1);
  testing::write_text(t / "b/history.csv", "load [N]\n1\n");
  EXPECT_NE(error_of(t / "b").find("its first column is not `time`"), std::string::npos);
  testing::make_running(t / "c", 1);
  testing::write_text(t / "c/fields.pvd", "<VTKFile><Coll");
  EXPECT_NE(error_of(t / "c").find("no PVD list"), std::string::npos);
}

} // namespace
} // namespace fissura::report
