// Frames read back.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

#include "fissura/core/error.hpp"
#include "fissura/output/read_frame.hpp"
#include "fissura/output/vtk_file.hpp"
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
  return support::refusal(core::Failure::io, [&] { FrameFile(path).floats("CellData", "stress"); });
}

void overwrite(std::string const& path, std::string const& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// Requirement: what write_vtu writes is read back, array by array, in the type that is asked for.
TEST(ReadFrame, ReadsWhatIsWritten) {
  TemporaryFolder const folder;
  write_vtu(folder / "a.vtu", two_lines());
  FrameFile const file(folder / "a.vtu");
  EXPECT_EQ(file.points(), 4u);
  EXPECT_EQ(file.cells(), 2u);
  EXPECT_EQ(file.floats("CellData", "stress"), (std::vector<float>{1e6F, -2e6F}));
  EXPECT_EQ(file.integers("CellData", "bar"), (std::vector<std::int64_t>{0, 7}));
  EXPECT_EQ(file.doubles("Points", "Points", 3)[11], 3.5);
  EXPECT_EQ(file.integers("Cells", "offsets"), (std::vector<std::int64_t>{2, 4}));
  EXPECT_TRUE(file.has("PointData", "displacement"));
  EXPECT_FALSE(file.has("CellData", "displacement"));
}

// Requirement: arrays of more than one block, and of none, come back whole.
TEST(ReadFrame, InflatesAnyNumberOfBlocks) {
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(i % 251);
  EXPECT_EQ(inflate_blocks(zlib_blocks(bytes, 64), 0), bytes);
  EXPECT_EQ(inflate_blocks(zlib_blocks(bytes, 250), 0), bytes);
  EXPECT_EQ(inflate_blocks(zlib_blocks("", 64), 0), "");
}

// Requirement: a missing file, a file of another kind, a missing array and a damaged array are each named.
TEST(ReadFrame, NamesWhatIsWrong) {
  TemporaryFolder const folder;
  EXPECT_NE(message_of(folder / "none.vtu").find("cannot open"), std::string::npos);
  overwrite(folder / "text.vtu", "time [s],load [N]\n");
  EXPECT_NE(message_of(folder / "text.vtu").find("no frame with raw appended data"), std::string::npos);
  auto without = two_lines();
  without.cell_data.erase(without.cell_data.begin());
  write_vtu(folder / "without.vtu", without);
  EXPECT_NE(message_of(folder / "without.vtu").find("no array 'stress' under CellData"), std::string::npos);
}

// Requirement: a frame whose header was altered is refused with what is wrong in it.
TEST(ReadFrame, NamesWhatIsWrongInTheHeader) {
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
  expect("NumberOfPoints=\"4\"", "NumberOfPoints=\"99999999999999999999\"",
         "its header says '99999999999999999999' for NumberOfPoints");
  expect("NumberOfCells=\"2\"", "NumberOfCells=\"-2\"", "its header says '-2' for NumberOfCells");
  expect("Name=\"stress\" NumberOfComponents=\"1\"", "Name=\"stress\" NumberOfComponents=\"0\"",
         "array 'stress' has 0 components");
  expect("Name=\"stress\" NumberOfComponents=\"1\"", "Name=\"stress\" NumberOfComponents=\"2\"",
         "array 'stress' has 2 components instead of 1");
  expect("\"Float32\" Name=\"stress\"", "\"Float16\" Name=\"stress\"", "it cannot be of type 'Float16'");
}

// Requirement: cells that name points which are not there, or that overlap, are refused.
TEST(ReadFrame, ChecksCells) {
  TemporaryFolder const folder;
  auto const expect = [&](std::vector<std::int64_t> const& connectivity,
                          std::vector<std::int64_t> const& offsets, std::string const& reason) {
    VtkFile file("UnstructuredGrid");
    auto piece = file.add_piece();
    piece.append_attribute("NumberOfPoints") = 4;
    piece.append_attribute("NumberOfCells") = static_cast<int>(offsets.size());
    auto cells = piece.append_child("Cells");
    file.add(cells, "connectivity", 1, connectivity);
    file.add(cells, "offsets", 1, offsets);
    file.save(folder / "a.vtu"); // write_vtu would refuse them
    std::string const text =
        support::refusal(core::Failure::io, [&] { FrameFile(folder / "a.vtu").cell_list("Cells"); });
    EXPECT_NE(text.find(reason), std::string::npos) << text;
  };
  expect({0, 1, 2, 3}, {2, 4}, "accepted");
  expect({0, 1, 2, 4}, {2, 4}, "a cell names point 4 of 4");
  expect({0, 1, 2, -1}, {2, 4}, "a cell names point -1 of 4");
  expect({0, 1, 2, 3}, {3, 2}, "the offsets of its cells decrease");
  expect({0, 1, 2, 3}, {2, 3}, "its last cell ends at 3 of 4 corners");
}

// Requirement: a folder or a pipe under the name of a frame is refused at once.
TEST(ReadFrame, ReadsFilesOnly) {
  TemporaryFolder const folder;
  EXPECT_NE(message_of(folder.name()).find("it is no file"), std::string::npos);
}

// Requirement: an array that says it unpacks to more than its bytes can hold is refused before memory is
// asked for.
TEST(ReadFrame, RefusesArraysThatSayTheyAreHuge) {
  auto const refused = [](std::uint64_t blocks, std::uint64_t full, std::uint64_t last) {
    std::string bytes = zlib_blocks("some bytes", 64);
    std::uint64_t const header[3] = {blocks, full, last};
    std::memcpy(bytes.data(), header, sizeof header);
    bytes.resize(4096);
    try {
      inflate_blocks(bytes, 0);
    } catch (std::runtime_error const& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  EXPECT_THROW(inflate_blocks(zlib_blocks("some bytes"), 0, 9), std::runtime_error);
  EXPECT_EQ(inflate_blocks(zlib_blocks("some bytes"), 0, 10), "some bytes");
  EXPECT_EQ(refused(1, std::uint64_t{1} << 40, 0), "an array has no valid header");
  EXPECT_EQ(refused(std::uint64_t{1} << 60, 64, 0), "an array has no valid header");
  EXPECT_EQ(refused(4000, std::uint64_t{1} << 26, 0), "an array has no valid header");
  EXPECT_EQ(refused(1, std::uint64_t{1} << 26, 0), "a compressed block is damaged");
}

// Requirement: a frame cut off at any place gives an error, never a crash or wrong numbers.
TEST(ReadFrame, RefusesAnyBeginningOfAFrame) {
  TemporaryFolder const folder;
  write_vtu(folder / "a.vtu", two_lines());
  std::string const whole = read_bytes(folder / "a.vtu");
  std::size_t const data = whole.find('_', whole.find("<AppendedData")) + 1;
  for (std::size_t size = 0; size < data + 60; size += 7) {
    overwrite(folder / "cut.vtu", whole.substr(0, size));
    try {
      FrameFile const file(folder / "cut.vtu");
      for (char const* name : {"connectivity", "offsets", "types"}) file.integers("Cells", name);
      ADD_FAILURE() << "a file cut off after " << size << " bytes was read";
    } catch (core::Error const& e) {
      EXPECT_EQ(e.failure, core::Failure::io);
    }
  }
}

} // namespace
} // namespace fissura::output
