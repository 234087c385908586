// Checkpoints on the disk: whole, or refused with the reason.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "fissura/checkpoint/file.hpp"
#include "fissura/checkpoint/store.hpp"
#include "fissura/core/error.hpp"
#include "fissura/core/hash.hpp"
#include "support/refusal.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::checkpoint {
namespace {

namespace fs = std::filesystem;
using output::testing::read_bytes;
using output::testing::TemporaryFolder;

void write_numbers(std::string const& path, int count = 1000) {
  write_file(path, [&](Saver& save) {
    for (int i = 0; i < count; ++i) save(0.1 * i);
  });
}
void overwrite(std::string const& path, std::string const& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}
std::string refusal(auto const& action) {
  return support::refusal(core::Failure::input, action);
}
std::string refusal_of(std::string const& path) {
  return refusal([&] { read_file(path); });
}
bool holds(std::string const& text, std::string const& part) {
  return text.find(part) != std::string::npos;
}

// Requirement: a file gives back what was written, small pieces and large ones.
TEST(CheckpointFile, gives_back_its_contents) {
  TemporaryFolder const folder;
  std::string const large(300000, 'x');
  write_file(folder / "a", [&](Saver& save) { save(1.5, large, 7), save.bytes("end"); });
  std::string const contents = read_file(folder / "a");
  Loader load(std::string_view(contents).substr(0, contents.size() - 3), "a");
  double x = 0;
  std::string text;
  int n = 0;
  load(x, text, n);
  load.finish();
  EXPECT_EQ(x, 1.5);
  EXPECT_EQ(text, large);
  EXPECT_EQ(n, 7);
  EXPECT_FALSE(fs::exists(folder / "a.part"));
}

// Requirement: a file cut off anywhere is refused, and says so once it is known for a checkpoint.
TEST(CheckpointFile, cut_off_is_refused) {
  TemporaryFolder const folder;
  write_numbers(folder / "a");
  std::string const bytes = read_bytes(folder / "a");
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 30) {
    overwrite(folder / "b", bytes.substr(0, size));
    std::string const text = refusal_of(folder / "b");
    EXPECT_TRUE(holds(text, folder / "b")) << text;
    EXPECT_TRUE(holds(text, size < 24 ? "not a checkpoint" : "cut off")) << size << ": " << text;
  }
}

// Requirement: a file with any one bit changed is refused; most say that it has been altered.
TEST(CheckpointFile, altered_is_refused) {
  TemporaryFolder const folder;
  write_numbers(folder / "a", 40);
  std::string const bytes = read_bytes(folder / "a");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ (1 << (i % 8)));
    std::string const said = refusal([&] { contents_of(changed, "b"); });
    EXPECT_NE(said, "accepted") << i;
    EXPECT_TRUE(i < 24 || holds(said, "altered")) << i << ": " << said;
  }
}

// Requirement: bytes put in or left behind at the end do not pass.
TEST(CheckpointFile, of_another_length_is_refused) {
  TemporaryFolder const folder;
  write_numbers(folder / "a");
  std::string bytes = read_bytes(folder / "a");
  EXPECT_TRUE(holds(refusal([&] { contents_of(bytes + "more", "b"); }), "cut off, or altered"));
  bytes.insert(100, "more");
  EXPECT_TRUE(holds(refusal([&] { contents_of(bytes, "b"); }), "its length is not the one it names"));
}

// Requirement: another format is refused with both numbers, before anything else of it is believed.
TEST(CheckpointFile, of_another_version_is_refused) {
  TemporaryFolder const folder;
  write_numbers(folder / "a");
  std::string bytes = read_bytes(folder / "a");
  auto refused_as = [&](std::uint32_t version) {
    std::memcpy(bytes.data() + 16, &version, sizeof version);
    return refusal([&] { contents_of(bytes, "b"); });
  };
  static_assert(format_version == 4);
  EXPECT_TRUE(holds(refused_as(5), "has the format 5, this program reads up to 4")) << refused_as(5);
  EXPECT_TRUE(holds(refused_as(0), "has been altered: there is no format 0")) << refused_as(0);
  EXPECT_TRUE(holds(refused_as(3), "has the format 3, this program reads 4")) << refused_as(3);
}

// Requirement: other files are told from checkpoints, and what is no file or is missing is named.
TEST(CheckpointFile, that_is_none_is_refused) {
  TemporaryFolder const folder;
  overwrite(folder / "a", "title = \"a deck, and long enough for the head of a checkpoint\"\n");
  EXPECT_TRUE(holds(refusal_of(folder / "a"), "not a checkpoint of Fissura"));
  EXPECT_TRUE(holds(refusal_of(folder.name()), "not a file"));
  try {
    read_file(folder / "missing");
    ADD_FAILURE();
  } catch (core::Error const& e) {
    EXPECT_EQ(e.failure, core::Failure::io);
    EXPECT_TRUE(holds(e.what(), "missing"));
  }
}

// Requirement: the last two checkpoints are kept, numbers rise, and a new store goes on counting.
TEST(CheckpointStore, keeps_the_last_two) {
  TemporaryFolder const folder;
  auto const write = [](Store& store) { return store.write([](Saver& save) { save(1); }); };
  {
    Store store(folder.name());
    EXPECT_EQ(store.last(), "");
    for (int i = 0; i < 4; ++i) write(store);
    EXPECT_EQ(store.last(), folder / "checkpoints/checkpoint_00004.bin");
  }
  Store store(folder.name());
  EXPECT_EQ(write(store), folder / "checkpoints/checkpoint_00005.bin");
  int files = 0;
  for (auto const& entry : fs::directory_iterator(folder / "checkpoints")) files += entry.is_regular_file();
  EXPECT_EQ(files, 2);
  EXPECT_TRUE(fs::exists(folder / "checkpoints/checkpoint_00004.bin"));
  EXPECT_EQ(find(folder.name()), folder / "checkpoints/checkpoint_00005.bin");
  EXPECT_EQ(find(folder / "checkpoints/checkpoint_00004.bin"), folder / "checkpoints/checkpoint_00004.bin");
}

// Requirement: going back to an older checkpoint removes the newer ones and what was left half written.
TEST(CheckpointStore, can_be_cut_back) {
  TemporaryFolder const folder;
  Store store(folder.name());
  std::string const older = store.write([](Saver& save) { save(1); });
  store.write([](Saver& save) { save(2); });
  overwrite(folder / "checkpoints/checkpoint_00003.bin.part", "half");
  store.cut_back_to(older);
  int files = 0;
  for (auto const& entry : fs::directory_iterator(folder / "checkpoints")) files += entry.is_regular_file();
  EXPECT_EQ(files, 1);
  EXPECT_EQ(store.last(), older);
  EXPECT_EQ(store.write([](Saver& save) { save(3); }), folder / "checkpoints/checkpoint_00002.bin");
}

// Requirement: a copy taken over into another run is the same checkpoint.
TEST(CheckpointStore, adopts_a_checkpoint) {
  TemporaryFolder const folder;
  Store from(folder / "a"), to(folder / "b");
  std::string const path = from.write([](Saver& save) { save(42); });
  to.adopt(path);
  EXPECT_EQ(read_bytes(folder / "b/checkpoints/checkpoint_00001.bin"), read_bytes(path));
}

// Requirement: a folder that cannot be made and an old checkpoint that cannot be removed are I/O failures
// with path and reason; the new checkpoint is there all the same.
TEST(CheckpointStore, names_what_it_cannot_do) {
  TemporaryFolder const folder;
  auto const io_error = [](auto const& action) { return support::refusal(core::Failure::io, action); };
  overwrite(folder / "file", "");
  EXPECT_EQ(io_error([&] { Store(folder / "file"); }),
            folder / "file" + "/checkpoints: cannot create the folder: Not a directory");
  std::string const stubborn = folder / "checkpoints/checkpoint_00001.bin";
  fs::create_directories(stubborn + "/more");
  Store store(folder.name());
  store.write([](Saver& save) { save(2); });
  EXPECT_EQ(io_error([&] { store.write([](Saver& save) { save(3); }); }),
            "cannot remove '" + stubborn + "': Directory not empty");
  EXPECT_NO_THROW(read_file(folder / "checkpoints/checkpoint_00003.bin"));
}

// Requirement: a place without a checkpoint, and a checkpoint away from its run folder, are refused in words.
TEST(CheckpointStore, names_what_is_missing) {
  TemporaryFolder const folder;
  EXPECT_TRUE(holds(refusal([&] { find(folder / "nowhere"); }), "neither a checkpoint nor a run folder"));
  EXPECT_TRUE(holds(refusal([&] { find(folder.name()); }), "no checkpoint in this run folder"));
  EXPECT_TRUE(holds(refusal([&] { run_folder_of(folder / "moved.bin"); }), "read from where it was written"));
  EXPECT_EQ(run_folder_of(folder / "checkpoints/checkpoint_00001.bin"), folder.name());
}

} // namespace
} // namespace fissura::checkpoint
