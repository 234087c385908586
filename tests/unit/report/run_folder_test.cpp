// Run folders read back.
#include <gtest/gtest.h>

#include "fissura/core/error.hpp"
#include "fissura/report/run_folder.hpp"
#include "fissura/report/watch.hpp"
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

// Requirement: a damaged file of a run folder is refused with its name and what is wrong in it.
TEST(RunFolder, NamesWhatIsDamaged) {
  struct Damage {
    char const *file, *text, *reason;
  };
  std::string const deep = "{\"status\": " + std::string(100, '[') + std::string(100, ']') + "}";
  for (auto const& [file, text, reason] : std::initializer_list<Damage>{
           {"run.json", "", "no JSON object"},
           {"run.json", "[1]", "no JSON object"},
           {"run.json", "{}", "it has no `status`"},
           {"run.json", R"({"status": 1})", "`status` is no text"},
           {"run.json", R"({"status": "complete", "time": "1"})", "`time` is no number"},
           {"run.json", R"({"status": "complete", "fragments": 3})", "`fragments` is no object"},
           {"run.json", R"({"status": "complete", "fragments": {"count": "3"}})",
            "`fragments.count` is no number"},
           {"run.json", R"({"status": "complete", "fragments": {"count": 3}})",
            "`fragments.largest` is no list of pieces"},
           {"run.json", R"({"status": "complete", "fragments": {"largest": [1]}})",
            "`fragments.largest` is no list of pieces"},
           {"run.json", deep.c_str(), "its brackets stand too deep in each other"},
           {"history.csv", "time [s],a [N]\n0,1\n1\n", "line 3 has 1 values for 2 columns"},
           {"history.csv", "time [s],a [N]\n0,1\n1,one\n", "line 3: 'one' is no number"},
           {"fields.pvd", R"(<VTKFile><Collection><DataSet file="a"/></Collection></VTKFile>)",
            "frame 1 has no time"},
           {"bars.pvd",
            R"(<VTKFile><Collection><DataSet timestep="0" file="a/../../b"/></Collection></VTKFile>)",
            "it names 'a/../../b', which does not lie in the run folder"},
           {"bars.pvd", R"(<VTKFile><Collection><DataSet timestep="0"/></Collection></VTKFile>)",
            "it names '', which does not lie in the run folder"}}) {
    TemporaryFolder const t;
    testing::make_running(t / "run", 1);
    testing::write_text(t / "run/" + std::string(file), text);
    std::string const said = error_of(t / "run");
    EXPECT_NE(said.find(file + std::string("': ") + reason), std::string::npos) << said;
  }
}

// Requirement: what lies under the name of a file and is none (a folder, a link to itself) is refused, not
// taken for missing.
TEST(RunFolder, ReadsFilesOnly) {
  TemporaryFolder const t;
  testing::make_running(t / "a", 1);
  std::filesystem::create_directory(t / "a/run.json");
  EXPECT_NE(error_of(t / "a").find("run.json': it is no file"), std::string::npos);
  testing::make_running(t / "b", 1);
  std::filesystem::create_symlink("run.json", t / "b/run.json");
  EXPECT_NE(error_of(t / "b").find("run.json': Too many levels of symbolic links"), std::string::npos);
  testing::write_text(t / "c", "time [s]\n");
  EXPECT_NE(error_of(t / "c").find("it is a file, no run folder"), std::string::npos);
}

// Requirement: names with control characters reach a screen as text.
TEST(RunFolder, ShowsNamesOnAScreenAsText) {
  TemporaryFolder const t;
  testing::make_running(t / "run", 1);
  testing::finish(t / "run", "beam");
  testing::write_text(t / "run/log.txt", "2026-01-31 12:00:00 info: \x1b[2J\n");
  RunFolder const run(t / "run");
  std::string const screen = watch_screen(run, {});
  EXPECT_EQ(screen.find('\x1b'), std::string::npos);
  EXPECT_NE(screen.find("\\x1b[2J"), std::string::npos) << screen;
}

} // namespace
} // namespace fissura::report
