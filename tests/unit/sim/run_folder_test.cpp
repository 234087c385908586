// What cannot be done with the files of a run folder, and what a restart does not take for its own.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "fissura/checkpoint/file.hpp"
#include "fissura/checkpoint/store.hpp"
#include "fissura/core/error.hpp"
#include "fissura/sim/fields.hpp"
#include "fissura/sim/identity.hpp"
#include "fissura/sim/log.hpp"
#include "fissura/sim/run.hpp"
#include "fissura/sim/run_folder.hpp"
#include "fissura/state/state.hpp"
#include "support/cases.hpp"
#include "support/refusal.hpp"
#include "support/unprivileged.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::support {
namespace {

namespace fs = std::filesystem;
using output::testing::read_bytes;
using output::testing::TemporaryFolder;

std::string io_error(auto const& action) {
  return support::refusal(core::Failure::io, action);
}
void expect_part(std::string const& text, std::string const& part) {
  EXPECT_NE(text.find(part), std::string::npos) << part << "\n  is not in\n" << text;
}

// Requirement: a run folder that is there already stays as it is unless --force is given.
TEST(RunFolderFiles, are_not_overwritten) {
  TemporaryFolder const folder;
  expect_part(io_error([&] { sim::make_folder(folder.name(), false); }),
              folder.name() + " exists already; choose another --out or add --force");
  EXPECT_NO_THROW(sim::make_folder(folder.name(), true));
}

// Requirement: a folder that cannot be made because a file is in its place is an I/O failure with its path.
TEST(RunFolderFiles, cannot_be_where_a_file_is) {
  TemporaryFolder const folder;
  std::ofstream(folder / "file") << "text";
  expect_part(io_error([&] { sim::make_folder(folder / "file/run", false); }),
              "file/run: cannot create the run folder: Not a directory");
  expect_part(io_error([&] { sim::FieldWriter(folder / "file"); }),
              "file/frames: cannot create the folder: Not a directory");
  expect_part(io_error([&] { sim::copy_start(folder.name(), folder / "file", {}); }),
              "cannot create the folder '" + folder / "file/frames': Not a directory");
  sim::Log log(true);
  expect_part(io_error([&] { log.open_file(folder / "file/log.txt"); }),
              "cannot open the log '" + folder / "file/log.txt': Not a directory");
}

// Requirement: a start of a run that lacks its history cannot be copied, and says so.
TEST(RunFolderFiles, are_copied_or_named) {
  TemporaryFolder const folder;
  expect_part(io_error([&] { sim::copy_start(folder / "old", folder / "new", {}); }),
              "cannot copy '" + folder / "old/history.csv': No such file or directory");
}

// Requirement: files that may not be changed are I/O failures with path and reason: a log that cannot be cut
// back, an old run that cannot be removed.
TEST(RunFolderFiles, of_somebody_else_are_named) {
  TemporaryFolder const folder;
  std::ofstream(folder / "log.txt") << "a line\n";
  std::ofstream(folder / "history.csv") << "time [s]\n";
  fs::permissions(folder / "log.txt", fs::perms(0444));
  fs::permissions(folder.name(), fs::perms(0555));
  {
    Unprivileged const nobody;
    if (!nobody.is()) GTEST_SKIP() << "root stays root here";
    expect_part(io_error([&] { sim::cut_back(folder.name(), {}); }),
                "cannot cut back '" + folder / "log.txt': Permission denied");
    expect_part(io_error([&] { sim::make_folder(folder.name(), true); }),
                "cannot remove '" + folder / "history.csv': Permission denied");
  }
  fs::permissions(folder.name(), fs::perms(0755));
}

sim::RunOptions options_for(std::string const& out) {
  sim::RunOptions o;
  o.out = out, o.deck_echo = "x", o.version = "1", o.quiet = true, o.threads = 1;
  return o;
}
/// A tie that stops half way, between two rows of its history, with a checkpoint.
model::Case stopping_tie(long last_step) {
  auto c = tie_case({4, 1, 1}, 6e-4, 1);
  c.output.history_points = 20, c.output.frames = 3;
  c.run.max_steps = last_step;
  return c;
}

class RestartFiles : public testing::Test {
 protected:
  void SetUp() override {
    sim::run_case(stopping_tie(40), options_for(folder / "run"));
    path = checkpoint::find(folder / "run");
  }
  /// Why the run does not go on.
  std::string refusal() const {
    auto o = options_for(folder / "run");
    o.restart = folder / "run";
    return support::refusal(core::Failure::input, [&] { sim::run_case(stopping_tie(50), o); });
  }
  /// Replaces the bytes of the checkpoint from `at` on, counted from the end of the stages in it.
  template <class T> std::string refusal_with(std::size_t at, T const& value) const {
    std::string contents = checkpoint::read_file(path);
    double const end = 6e-4;
    std::string const pattern(reinterpret_cast<char const*>(&end), sizeof end);
    std::size_t const stages = contents.rfind(pattern);
    EXPECT_NE(stages, std::string::npos);
    std::memcpy(contents.data() + stages + at, &value, sizeof value);
    checkpoint::write_file(path, [&](checkpoint::Saver& save) { save.bytes(contents); });
    return refusal();
  }
  TemporaryFolder const folder;
  std::string path;
};

// Requirement: a history with a row that lacks a value is not gone on with.
TEST_F(RestartFiles, need_whole_rows) {
  std::string history = read_bytes(folder / "run/history.csv");
  auto const row = history.find('\n', history.find('\n') + 1) + 1;
  history[history.find(',', row)] = '7';
  std::ofstream(folder / "run/history.csv") << history;
  expect_part(refusal(),
              "history.csv: error: the run cannot go on with this file: a row has too few or too many "
              "values");
}

// Requirement: a checkpoint whose run ends at no time is refused.
TEST_F(RestartFiles, need_an_end) {
  expect_part(refusal_with(0, -1.0), "the end of the run is no time");
}

// Requirement: a checkpoint whose rows were counted below zero is refused.
TEST_F(RestartFiles, need_counts) {
  expect_part(refusal_with(8 + sizeof(int), std::int64_t{-1}), "rows or frames were never counted so");
}

// Requirement: a checkpoint of another mesh, record or time step is refused, and each says what to do.
TEST(Restart, needs_the_same_case) {
  std::string const nothing;
  checkpoint::Loader const from(nothing, "checkpoint_00001.bin");
  sim::Identity const now{"2", "v3", "deck", "deck", 1, 2, 1e-6};
  auto const refusal_of = [&](auto const& change) {
    auto saved = now;
    saved.version = "1";
    change(saved);
    return support::refusal(core::Failure::input, [&] { sim::compare(saved, now, from); });
  };
  EXPECT_TRUE(sim::compare(now, now, from).empty());
  expect_part(refusal_of([](auto& saved) { saved.mesh = 9; }),
              "the mesh has changed since; run it anew, or with the mesh as it was");
  expect_part(refusal_of([](auto& saved) { saved.records = 9; }),
              "a record of a load has changed since, or a program has changed a load in mid-run; run it "
              "anew, or with "
              "the record as it was");
  expect_part(refusal_of([](auto& saved) { saved.dt = 2e-6; }),
              "the time step is 1e-06 s now and was 2e-06 s: the program finds another one, go on with the "
              "version that wrote it (1)");
}

// Requirement: a log that cannot be written to ends the run: it is not passed over in silence.
TEST(LogFile, that_is_full_is_an_error) {
  sim::Log log(true);
  log.open_file("/dev/full");
  expect_part(io_error([&] { log.info("a line"); }), "cannot write '/dev/full': No space left on device");
}

// Requirement: a state that has gone wrong ends the run before it becomes a checkpoint; the last good one
// stays.
TEST(Checkpoints, are_never_of_a_bad_state) {
  TemporaryFolder const folder;
  auto c = stopping_tie(0);
  c.output.checkpoint_steps = 1;
  sim::Run run(c, options_for(folder / "run"));
  run.open();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(run.step());
  std::string const last = checkpoint::find(folder / "run");
  std::string const bytes = read_bytes(last);
  // A number that no step reads, and the guards look for in every tenth step only.
  auto& account = const_cast<state::State&>(run.state()).bars.account;
  ASSERT_FALSE(account.empty());
  account[0].dowel = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(run.step());
  EXPECT_EQ(run.finish().status, "failed");
  expect_part(run.result().reason, "a number is no longer finite: ");
  EXPECT_EQ(checkpoint::find(folder / "run"), last);
  EXPECT_EQ(read_bytes(last), bytes);
}

} // namespace
} // namespace fissura::support
