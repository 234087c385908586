#include <fcntl.h>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <unistd.h>

#include "fissura/core/error.hpp"
#include "fissura/output/atomic_file.hpp"
#include "fissura/output/csv.hpp"
#include "fissura/output/json.hpp"
#include "fissura/output/pvd.hpp"
#include "fissura/output/vtu.hpp"
#include "temporary_folder.hpp"

namespace fissura::output {
namespace {

namespace fs = std::filesystem;
using testing::read_bytes;
using testing::TemporaryFolder;

void expect_io_error(std::function<void()> const& action, std::vector<std::string> const& words) {
  try {
    action();
    ADD_FAILURE() << "no error, expected: " << words.front();
  } catch (core::Error const& e) {
    EXPECT_EQ(e.failure, core::Failure::io);
    for (std::string const& w : words)
      EXPECT_NE(std::string(e.what()).find(w), std::string::npos) << e.what();
  }
}

// Requirement: until commit() a reader sees the old content; afterwards the new one, and no temporary stays.
TEST(AtomicFile, AppearsWhole) {
  TemporaryFolder folder;
  replace_file(folder / "f", "old");
  {
    AtomicFile file(folder / "f");
    file.write("new ");
    file.write("content");
    EXPECT_EQ(read_bytes(folder / "f"), "old");
    file.commit();
  }
  EXPECT_EQ(read_bytes(folder / "f"), "new content");
  EXPECT_FALSE(fs::exists(folder / "f.part"));
}

// Requirement: a file given up half way (an exception in the writer) leaves the old content and no temporary.
TEST(AtomicFile, GivenUpLeavesOldContent) {
  TemporaryFolder folder;
  replace_file(folder / "f", "old");
  { AtomicFile(folder / "f").write("half"); }
  EXPECT_EQ(read_bytes(folder / "f"), "old");
  EXPECT_FALSE(fs::exists(folder / "f.part"));
}

// Requirement: a file that cannot be opened is an I/O failure with path and reason, for every kind of output.
TEST(AtomicFile, OpenFails) {
  TemporaryFolder folder;
  std::string const path = folder / "missing/f";
  std::vector<std::string> const words{"cannot open '" + path, "No such file or directory"};
  expect_io_error([&] { replace_file(path, "x"); }, words);
  expect_io_error([&] { write_vtu(path, {}); }, words);
  expect_io_error([&] { PvdWriter(path).add(0, {"a.vtu"}); }, words);
  expect_io_error([&] { write_json(path, 1); }, words);
  expect_io_error([&] { CsvWriter(path, {}); }, words);
}

// Requirement: a full disk is an I/O failure with path and reason, and the previous version stays.
TEST(AtomicFile, DiskFull) {
  TemporaryFolder folder;
  std::string const path = folder / "f";
  auto const on_full_disk = [&](std::function<void()> const& action) {
    replace_file(path, "old");
    fs::create_symlink("/dev/full", path + ".part");
    expect_io_error(action, {"cannot write '" + path, "No space left on device"});
    EXPECT_EQ(read_bytes(path), "old");
    EXPECT_FALSE(fs::exists(fs::symlink_status(path + ".part")));
  };
  on_full_disk([&] { replace_file(path, "x"); });
  on_full_disk([&] { write_vtu(path, {}); });
  on_full_disk([&] { PvdWriter(path).add(0, {"a.vtu"}); });
  on_full_disk([&] { write_json(path, 1); });
  expect_io_error([] { CsvWriter("/dev/full", {}); },
                  {"cannot write '/dev/full'", "No space left on device"});
}

// Requirement: a flush that fails is an I/O failure: data the disk has refused is not taken for saved.
TEST(AtomicFile, FlushFails) {
  TemporaryFolder folder;
  std::string const path = folder / "f";
  fs::create_symlink("/dev/null", path + ".part"); // takes every byte, but cannot be flushed
  expect_io_error([&] { replace_file(path, "x"); }, {"cannot flush '" + path, "Invalid argument"});
  EXPECT_FALSE(fs::exists(path));
}

// Requirement: a read, a close and the flush of a folder that fail are I/O failures with path and reason.
TEST(AtomicFile, OtherCallsFail) {
  TemporaryFolder folder;
  int const only_written = ::open((folder / "w").c_str(), O_WRONLY | O_CREAT, 0666);
  expect_io_error([&] { read_all(only_written, 10, folder / "w"); },
                  {"cannot read '" + folder / "w", "Bad file descriptor"});
  EXPECT_NO_THROW(close_file(only_written, folder / "w"));
  expect_io_error([&] { close_file(only_written, folder / "w"); },
                  {"cannot close '" + folder / "w", "Bad file descriptor"});
  expect_io_error([&] { flush_folder(folder / "gone"); },
                  {"cannot open the folder '" + folder / "gone", "No such file or directory"});
}

// Requirement: a file is read from where it stands, and no further than it goes.
TEST(AtomicFile, ReadsWhatIsThere) {
  TemporaryFolder folder;
  replace_file(folder / "f", "0123456789");
  int const descriptor = ::open((folder / "f").c_str(), O_RDONLY);
  EXPECT_EQ(read_all(descriptor, 4, folder / "f"), "0123");
  EXPECT_EQ(read_all(descriptor, 99, folder / "f"), "456789");
  close_file(descriptor, folder / "f");
}

// Requirement: a rename that fails is an I/O failure naming the target, and no temporary stays.
TEST(AtomicFile, RenameFails) {
  TemporaryFolder folder;
  std::string const path = folder / "f";
  fs::create_directory(path);
  expect_io_error([&] { replace_file(path, "x"); }, {"cannot rename to '" + path, "Is a directory"});
  EXPECT_FALSE(fs::exists(path + ".part"));
}

// Requirement: a file that is written to bit by bit must still be where its name says: not removed, not
// replaced.
TEST(AtomicFile, KnowsWhetherItIsStillThere) {
  TemporaryFolder folder;
  std::string const path = folder / "f";
  int const descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT, 0666);
  EXPECT_NO_THROW(check_in_place(descriptor, path));
  fs::remove(path);
  expect_io_error([&] { check_in_place(descriptor, path); },
                  {"cannot go on writing '" + path, "No such file or directory"});
  replace_file(path, "another");
  expect_io_error([&] { check_in_place(descriptor, path); },
                  {"cannot go on writing '" + path, "another file has taken its place"});
  close_file(descriptor, path);
  expect_io_error([&] { check_in_place(descriptor, path); },
                  {"cannot look at '" + path, "Bad file descriptor"});
}

} // namespace
} // namespace fissura::output
