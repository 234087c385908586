// The page that a run writes while it goes on and at its end.
#include <gtest/gtest.h>

#include <filesystem>

#include "fissura/report/page.hpp"
#include "fissura/sim/log.hpp"
#include "fissura/sim/report_writer.hpp"
#include "unit/report/support.hpp"

namespace fissura::sim {
namespace {

namespace fs = std::filesystem;
using report::testing::TemporaryFolder;

// Requirement: the first page comes after 20 s, the next one a minute later or more, and the last at the end.
TEST(ReportWriter, WritesNowAndThen) {
  if (report::page_template().empty()) GTEST_SKIP() << "built without npm";
  TemporaryFolder const t;
  report::testing::make_running(t / "run", 2);
  Log log(true);
  ReportWriter writer(t / "run", "1.2.3", true);
  auto const written = [&](double elapsed) {
    fs::remove(t / "run/report.html");
    writer.meanwhile(elapsed, log);
    return fs::exists(t / "run/report.html");
  };
  EXPECT_FALSE(written(19));
  EXPECT_TRUE(written(21));
  EXPECT_FALSE(written(60));
  EXPECT_TRUE(written(200));
  fs::remove(t / "run/report.html");
  writer.at_end(log);
  EXPECT_TRUE(fs::exists(t / "run/report.html"));
}

// Requirement: a run that wants no page, or has no folder, gets none.
TEST(ReportWriter, WritesNothingUnasked) {
  TemporaryFolder const t;
  report::testing::make_running(t / "run", 1);
  Log log(true);
  ReportWriter(t / "run", "", false).at_end(log);
  EXPECT_FALSE(fs::exists(t / "run/report.html"));
  EXPECT_NO_THROW(ReportWriter("", "", true).at_end(log));
}

// Requirement: a page for which the run folder lacks something is a warning in the log, never the end of the
// run.
TEST(ReportWriter, NeverEndsARun) {
  TemporaryFolder const t;
  report::testing::make_running(t / "run", 2);
  fs::remove(t / "run/frames/fields_1.vtu");
  Log log(true);
  log.open_file(t / "log.txt");
  EXPECT_NO_THROW(ReportWriter(t / "run", "", true).at_end(log));
  EXPECT_FALSE(fs::exists(t / "run/report.html"));
  if (report::page_template().empty()) return;
  EXPECT_NE(report::testing::read_bytes(t / "log.txt").find("warning: no report page: cannot open"),
            std::string::npos);
}

} // namespace
} // namespace fissura::sim
