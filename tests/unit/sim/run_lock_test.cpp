// A run folder is used by one run at a time.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "fissura/core/error.hpp"
#include "fissura/sim/run.hpp"
#include "fissura/sim/run_folder.hpp"
#include "fissura/sim/run_lock.hpp"
#include "support/cases.hpp"
#include "support/refusal.hpp"
#include "support/unprivileged.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::support {
namespace {

namespace fs = std::filesystem;
using output::testing::read_bytes;
using output::testing::TemporaryFolder;
using sim::RunLock;

// Requirement: a folder has one holder, which the refusal names; once it lets go the next one may, and no
// file is left.
TEST(Lock, has_one_holder) {
  TemporaryFolder const folder;
  {
    RunLock first(folder.name());
    EXPECT_TRUE(first.holds());
    std::string const text =
        support::refusal(core::Failure::io, [&] { RunLock const second(folder.name()); });
    EXPECT_NE(text.find(folder.name() + " is in use by process " + std::to_string(::getpid()) + " on "),
              std::string::npos)
        << text;
    RunLock moved = std::move(first);
    EXPECT_FALSE(first.holds());
    EXPECT_THROW(RunLock{folder.name()}, core::Error);
    moved.release();
    EXPECT_FALSE(moved.holds());
    EXPECT_TRUE(RunLock(folder.name()).holds());
  }
  EXPECT_TRUE(fs::is_empty(folder.name()));
}

// Requirement: what a killed run has left keeps nobody out, however long it is, and tells that a run was
// here.
TEST(Lock, of_the_dead_is_taken) {
  TemporaryFolder const folder;
  EXPECT_FALSE(RunLock::was_left_in(folder.name()));
  std::ofstream(folder / ".lock") << "fissura: in use by process 1 on a host with a very, very long name\n";
  EXPECT_TRUE(RunLock::was_left_in(folder.name()));
  RunLock const lock(folder.name());
  EXPECT_EQ(read_bytes(folder / ".lock").find("fissura: in use by process " + std::to_string(::getpid())),
            0U);
}

// Requirement: a folder in which nothing can be made is an I/O failure with the path.
TEST(Lock, needs_a_folder_to_write_in) {
  TemporaryFolder const folder;
  fs::permissions(folder.name(), fs::perms(0555));
  {
    Unprivileged const nobody;
    if (!nobody.is()) GTEST_SKIP() << "root stays root here";
    EXPECT_EQ(support::refusal(core::Failure::io, [&] { RunLock const lock(folder.name()); }),
              "cannot open the lock '" + folder / ".lock': Permission denied");
  }
  fs::permissions(folder.name(), fs::perms(0755));
}

model::Case tie() {
  auto c = tie_case({4, 1, 1}, 6e-4, 1);
  c.output.frames = 1;
  return c;
}
sim::RunOptions options(std::string const& out) {
  sim::RunOptions o;
  o.out = out, o.version = "1", o.quiet = true, o.threads = 1;
  return o;
}

// Requirement: while a run is at work in a folder, within this program or another, neither --force nor
// --restart gets in; after its end both do.
TEST(Lock, is_held_by_a_run_until_it_has_ended) {
  TemporaryFolder const folder;
  auto o = options(folder / "run");
  sim::Run run(tie(), o);
  run.open();
  ASSERT_TRUE(run.step());
  auto forced = o, restarted = o;
  forced.force = true;
  EXPECT_NE(support::refusal(core::Failure::io, [&] { sim::run_case(tie(), forced); }).find("is in use by"),
            std::string::npos);
  run.finish();
  restarted.restart = folder / "run";
  sim::Run other(tie(), restarted);
  EXPECT_NE(
      support::refusal(core::Failure::io, [&] { sim::run_case(tie(), restarted); }).find("is in use by"),
      std::string::npos);
  other.open();
  other.finish();
  EXPECT_FALSE(fs::exists(folder / "run/.lock"));
  EXPECT_EQ(sim::run_case(tie(), forced).status, "complete");
}

// Requirement: a folder that cannot be written to refuses a restart before anything is touched, and names
// what cannot be written.
TEST(Restart, needs_files_it_may_write) {
  TemporaryFolder const folder;
  sim::run_case(tie(), options(folder / "run"));
  fs::permissions(folder.name(), fs::perms(0755)); // nobody may look, at least
  fs::permissions(folder / "run", fs::perms(0777));
  for (char const* name : {"checkpoints", "frames", "history.csv", "log.txt"}) {
    fs::permissions(fs::path(folder / "run") / name, fs::perms(0555));
    {
      Unprivileged const nobody;
      if (!nobody.is()) GTEST_SKIP() << "root stays root here";
      EXPECT_EQ(support::refusal(core::Failure::io, [&] { sim::check_can_go_on_in(folder / "run"); }),
                "cannot write '" + folder / ("run/" + std::string(name)) +
                    "': Permission denied; nothing has been changed");
    }
    fs::permissions(fs::path(folder / "run") / name, fs::perms(0777));
  }
  Unprivileged const nobody;
  EXPECT_NO_THROW(sim::check_can_go_on_in(folder / "run"));
}

// Requirement: --force takes a folder of a run, an empty one, one that a killed run has just begun and one
// that is not there; every other is refused with the reason.
TEST(Force, clears_run_folders_only) {
  TemporaryFolder const folder;
  auto const refused = [&](std::string const& name, std::string const& deck = "") {
    return support::refusal(core::Failure::io, [&] { sim::check_may_force(folder / name, deck); });
  };
  EXPECT_NO_THROW(sim::check_may_force(folder / "nowhere", ""));
  for (char const* made :
       {"history", "summary", "checkpoint/checkpoints", "lock", "empty", "mine/frames", "deck"})
    fs::create_directories(folder / made);
  std::ofstream(folder / "history/history.csv") << "time [s],u [m]\n";
  std::ofstream(folder / "summary/run.json") << "{\"state_hash\": \"0\"}";
  std::ofstream(folder / "checkpoint/checkpoints/checkpoint_00001.bin") << "x";
  std::ofstream(folder / "lock/.lock") << "fissura: in use by process 1 on x\n";
  for (char const* good : {"history", "summary", "checkpoint", "lock", "empty"})
    EXPECT_NO_THROW(sim::check_may_force(folder / good, "")) << good;
  std::ofstream(folder / "mine/case.toml") << "# Every value of this run, defaults included.\n";
  std::ofstream(folder / "mine/history.csv") << "date,price\n";
  EXPECT_EQ(refused("mine"),
            "--force does not clear " + folder / "mine: it is no run folder (it holds files, but "
                                                 "neither history.csv, run.json nor checkpoints of a "
                                                 "run); choose another --out");
  EXPECT_NE(refused("mine/case.toml").find("it is no folder"), std::string::npos);
  std::ofstream(folder / "history/case.toml") << "x";
  EXPECT_NE(refused("history", folder / "history/case.toml").find("the deck itself lies in it"),
            std::string::npos);
  EXPECT_NE(support::refusal(core::Failure::io, [&] { sim::check_may_force("/", ""); }).find("the root"),
            std::string::npos);
  std::string const home = std::getenv("HOME") ? std::getenv("HOME") : "";
  ::setenv("HOME", (folder / "history").c_str(), 1);
  EXPECT_NE(refused("history").find("it is your home"), std::string::npos);
  home.empty() ? ::unsetenv("HOME") : ::setenv("HOME", home.c_str(), 1);
}

// Requirement: numbers that have no meaning are refused before anything is done, naming the option.
TEST(Options, are_checked) {
  auto const refusal_of = [](auto const& change) {
    auto o = options("");
    change(o);
    return support::refusal(core::Failure::input, [&] { sim::Run const run(tie(), o); });
  };
  for (double const bad : {-1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(refusal_of([&](auto& o) { o.until = bad; }).find("--until must be a time of 0 s or more"), 0U);
    EXPECT_EQ(refusal_of([&](auto& o) { o.walltime = bad; }).find("--walltime must be a time of 0 s or more"),
              0U);
  }
  for (int const bad : {-2, sim::most_threads + 1})
    EXPECT_EQ(refusal_of([&](auto& o) { o.threads = bad; }),
              "--threads must be 0 (all) to 1024, not " + std::to_string(bad));
}

// Requirement: a run whose history has been taken away or replaced fails at its next row: it does not write
// on into nothing.
TEST(RunFolder, notices_that_a_file_has_vanished) {
  TemporaryFolder const folder;
  for (bool const replaced : {false, true}) {
    auto o = options(folder / (replaced ? "replaced" : "removed"));
    sim::Run run(tie(), o);
    run.open();
    ASSERT_TRUE(run.step());
    fs::remove(o.out + "/history.csv");
    if (replaced) std::ofstream(o.out + "/history.csv") << "mine";
    std::string const text = support::refusal(core::Failure::io, [&] {
      while (run.step()) {
      }
    });
    EXPECT_EQ(text, "cannot go on writing '" + o.out + "/history.csv': " +
                        (replaced ? "another file has taken its place" : "No such file or directory"));
  }
}

} // namespace
} // namespace fissura::support
