// Frames read back.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "fissura/core/error.hpp"
#include "fissura/output/read_vtu.hpp"
#include "fissura/output/vtu.hpp"
#include "fissura/output/zlib_blocks.hpp"
#include "support/refusal.hpp"
#include "temporary_folder.hpp"

namespace fissura::output {
namespace {

using testing::read_bytes;
using testing::TemporaryFolder;

Grid two_lines() {
  Grid g;
  g.points = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {1, 2, 3.5}};
  g.connectivity = {0, 1, 2, 3};
  g.offsets = {2, 4};
  g.types = {cell_type::line, cell_type::line};
  g.point_data = {{"displacement", 3, std::vector<float>(12, 0.5F), "m"}};
  g.cell_data = {{"stress", 1, std::vector<float>{1e6F, -2e6F}, "Pa"},
                 {"bar", 1, std::vector<std::int32_t>{0, 7}, ""}};
  return g;
}

std::string message_of(std::string const& path) {
  return support::refusal(core::Failure::io, [&] { VtuFile(path).floats("CellData", "stress"); });
}

void overwrite(std::string const& path, std::string const& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// Requirement: what write_vtu writes is read back, array by array, in the type that is asked for.
TEST(ReadVtu, ReadsWhatIsWritten) {
  TemporaryFolder const folder;
  write_vtu(folder / "a.vtu", two_lines());
  VtuFile const file(folder / "a.vtu");
  EXPECT_EQ(file.points(), 4u);
  EXPECT_EQ(file.cells(), 2u);
  EXPECT_EQ(file.floats("CellData", "stress"), (std::vector<float>{1e6F, -2e6F}));
  EXPECT_EQ(file.integers("CellData", "bar"), (std::vector<std::int64_t>{0, 7}));
  EXPECT_EQ(file.doubles("Points", "Points")[11], 3.5);
  EXPECT_EQ(file.integers("Cells", "offsets"), (std::vector<std::int64_t>{2, 4}));
  EXPECT_TRUE(file.has("PointData", "displacement"));
  EXPECT_FALSE(file.has("CellData", "displacement"));
}

// Requirement: arrays of more than one block, and of none, come back whole.
TEST(ReadVtu, InflatesAnyNumberOfBlocks) {
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(i % 251);
  EXPECT_EQ(inflate_blocks(zlib_blocks(bytes, 64), 0), bytes);
  EXPECT_EQ(inflate_blocks(zlib_blocks(bytes, 250), 0), bytes);
  EXPECT_EQ(inflate_blocks(zlib_blocks("", 64), 0), "");
}

// Requirement: a missing file, a file of another kind, a missing array and a damaged array are each named.
TEST(ReadVtu, NamesWhatIsWrong) {
  TemporaryFolder const folder;
  EXPECT_NE(message_of(folder / "none.vtu").find("cannot open"), std::string::npos);
  overwrite(folder / "text.vtu", "time [s],load [N]\n");
  EXPECT_NE(message_of(folder / "text.vtu").find("no VTU file"), std::string::npos);
  auto without = two_lines();
  without.cell_data.erase(without.cell_data.begin());
  write_vtu(folder / "without.vtu", without);
  EXPECT_NE(message_of(folder / "without.vtu").find("no array 'stress' under CellData"), std::string::npos);
}

// Requirement: a frame whose header was altered is refused with what is wrong in it.
TEST(ReadVtu, NamesWhatIsWrongInTheHeader) {
  TemporaryFolder const folder;
  write_vtu(folder / "a.vtu", two_lines());
  std::string const whole = read_bytes(folder / "a.vtu");
  auto const expect = [&](std::string const& old_text, std::string const& new_text,
                          std::string const& reason) {
    std::string changed = whole;
    ASSERT_NE(changed.find(old_text), std::string::npos) << old_text;
    changed.replace(changed.find(old_text), old_text.size(), new_text);
    overwrite(folder / "b.vtu", changed);
    std::string const text = message_of(folder / "b.vtu");
    EXPECT_NE(text.find(reason), std::string::npos) << text;
  };
  expect("<VTKFile", "<<TKFile", "its XML header is damaged");
  expect("LittleEndian", "BigEndian", "expected zlib blocks with UInt64 headers, little endian");
  expect("NumberOfCells=\"2\"", "NumberOfCells=\"3\"", "array 'stress' has 2 values instead of 3");
}

// Requirement: a frame cut off at any place gives an error, never a crash or wrong numbers.
TEST(ReadVtu, RefusesAnyBeginningOfAFrame) {
  TemporaryFolder const folder;
  write_vtu(folder / "a.vtu", two_lines());
  std::string const whole = read_bytes(folder / "a.vtu");
  std::size_t const data = whole.find('_', whole.find("<AppendedData")) + 1;
  for (std::size_t size = 0; size < data + 60; size += 7) {
    overwrite(folder / "cut.vtu", whole.substr(0, size));
    try {
      VtuFile const file(folder / "cut.vtu");
      for (char const* name : {"connectivity", "offsets", "types"}) file.integers("Cells", name);
      ADD_FAILURE() << "a file cut off after " << size << " bytes was read";
    } catch (core::Error const& e) {
      EXPECT_EQ(e.failure, core::Failure::io);
    }
  }
}

} // namespace
} // namespace fissura::output
