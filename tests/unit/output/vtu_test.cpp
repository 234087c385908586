#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

#include "fissura/core/error.hpp"
#include "fissura/output/read_frame.hpp"
#include "fissura/output/vtu.hpp"
#include "temporary_folder.hpp"
#include "vtu_reader.hpp"

namespace fissura::output {
namespace {

using testing::read_bytes;
using testing::TemporaryFolder;
using testing::VtuReader;

/// A tet, one of its faces, one of its edges and one corner, with a field of every value type.
Grid small_grid() {
  Grid g;
  g.points = {{0, 0, 0}, {1.0 / 3, 0, 0}, {0, 0.1, 0}, {0, 0, -2.5e-7}};
  g.connectivity = {0, 1, 2, 3, 0, 1, 2, 1, 3, 2};
  g.offsets = {4, 7, 9, 10};
  g.types = {cell_type::tetrahedron, cell_type::triangle, cell_type::line, cell_type::vertex};
  g.point_data = {{"displacement", 3, std::vector<double>{0, 1e-9, -2, 3, 4, 5, 6, 7, 8, 9, 10, 1e300}, "m"}};
  g.cell_data = {{"group", 1, std::vector<std::int32_t>{0, 1, -2147483647, 3}},
                 {"stress", 2, std::vector<float>{1.5F, -2.25F, 3e6F, 0, 1, 2, 3, 4}, "Pa"},
                 {"broken", 1, std::vector<std::uint8_t>{0, 1, 255, 0}},
                 {"id", 1, std::vector<std::int64_t>{1, 2, 3, std::int64_t{1} << 60}}};
  return g;
}

// Requirement: every array of a grid reads back bit for bit, with its type, components, place and unit.
TEST(Vtu, ReadsBackBitForBit) {
  TemporaryFolder folder;
  Grid const g = small_grid();
  write_vtu(folder / "a.vtu", g);
  std::string const file = read_bytes(folder / "a.vtu");
  VtuReader const r(file);

  EXPECT_EQ(testing::attribute(r.header, "NumberOfPoints"), "4");
  EXPECT_EQ(testing::attribute(r.header, "NumberOfCells"), "4");
  EXPECT_EQ(testing::attribute(r.header, "header_type"), "UInt64");
  ASSERT_EQ(r.arrays.size(), 9u);
  EXPECT_EQ(r.arrays.at("Points").as<double>(),
            (std::vector<double>{0, 0, 0, 1.0 / 3, 0, 0, 0, 0.1, 0, 0, 0, -2.5e-7}));
  EXPECT_EQ(r.arrays.at("connectivity").as<std::int64_t>(), g.connectivity);
  EXPECT_EQ(r.arrays.at("offsets").as<std::int64_t>(), g.offsets);
  EXPECT_EQ(r.arrays.at("types").as<std::uint8_t>(), (std::vector<std::uint8_t>{10, 5, 3, 1}));

  testing::ReadArray const& u = r.arrays.at("displacement");
  EXPECT_EQ(u.section, "PointData");
  EXPECT_EQ(u.type, "Float64");
  EXPECT_EQ(u.components, 3);
  EXPECT_EQ(u.unit, "m");
  EXPECT_EQ(u.as<double>(), std::get<std::vector<double>>(g.point_data[0].values));
  EXPECT_EQ(r.arrays.at("group").type, "Int32");
  EXPECT_EQ(r.arrays.at("group").as<std::int32_t>(),
            std::get<std::vector<std::int32_t>>(g.cell_data[0].values));
  EXPECT_EQ(r.arrays.at("stress").section, "CellData");
  EXPECT_EQ(r.arrays.at("stress").unit, "Pa");
  EXPECT_EQ(r.arrays.at("stress").as<float>(), std::get<std::vector<float>>(g.cell_data[1].values));
  EXPECT_EQ(r.arrays.at("broken").as<std::uint8_t>(),
            std::get<std::vector<std::uint8_t>>(g.cell_data[2].values));
  EXPECT_EQ(r.arrays.at("id").as<std::int64_t>(), std::get<std::vector<std::int64_t>>(g.cell_data[3].values));
}

// Requirement: arrays longer than one compressed block, also those that end on a block's edge, read back
// whole.
TEST(Vtu, LongArraysSpanBlocks) {
  TemporaryFolder folder;
  for (std::size_t const points : {std::size_t{16384}, std::size_t{16385}, std::size_t{50000}}) {
    Grid g;
    g.points.resize(points);
    std::vector<double> values(points); // 16384 doubles fill one block of 128 KiB exactly
    for (std::size_t i = 0; i < points; ++i) values[i] = std::sin(1e-3 * double(i * i));
    g.point_data = {{"v", 1, values}};
    write_vtu(folder / "long.vtu", g);
    std::string const file = read_bytes(folder / "long.vtu");
    VtuReader const r(file);
    EXPECT_EQ(r.arrays.at("v").as<double>(), values) << points;
    EXPECT_EQ(r.arrays.at("v").blocks, (points * 8 + 131071) / 131072) << points;
  }
}

// Requirement: a frame without cells (no crack yet) is a valid file with the same arrays.
TEST(Vtu, EmptyGridKeepsItsArrays) {
  TemporaryFolder folder;
  Grid g;
  g.cell_data = {{"opening", 1, std::vector<double>{}, "m"}};
  write_vtu(folder / "empty.vtu", g);
  std::string const file = read_bytes(folder / "empty.vtu");
  VtuReader const r(file);
  EXPECT_EQ(testing::attribute(r.header, "NumberOfCells"), "0");
  EXPECT_EQ(r.arrays.at("opening").bytes, "");
  EXPECT_EQ(r.arrays.at("opening").blocks, 0u);
}

// Requirement: a line break ends the raw data, which meshio looks for, and the time of the frame stands where
// VTK's readers look for it.
TEST(Vtu, EndsItsDataAndTellsItsTime) {
  TemporaryFolder folder;
  Grid g = small_grid();
  g.time = 0.0125;
  write_vtu(folder / "a.vtu", g);
  std::string const file = read_bytes(folder / "a.vtu");
  EXPECT_NE(file.find("\n</AppendedData>"), std::string::npos);
  EXPECT_EQ(file.find("</AppendedData>"), file.rfind("</AppendedData>"));
  std::size_t const time = file.find("Name=\"TimeValue\"");
  ASSERT_LT(time, file.find("<Piece"));
  EXPECT_NE(file.find("NumberOfTuples=\"1\"", time), std::string::npos);
  std::size_t const data = file.find("<AppendedData encoding=\"raw\">_") + 30;
  double value = 0;
  std::string const first = inflate_blocks(std::string_view(file).substr(data), 0);
  ASSERT_EQ(first.size(), sizeof value);
  std::memcpy(&value, first.data(), sizeof value);
  EXPECT_EQ(value, 0.0125);
}

// Requirement: names with XML's own characters do not break the file.
TEST(Vtu, NamesAreEscaped) {
  TemporaryFolder folder;
  Grid g;
  g.points.resize(1);
  g.point_data = {{"a<b&\"c", 1, std::vector<double>{7}}};
  write_vtu(folder / "a.vtu", g);
  EXPECT_NE(read_bytes(folder / "a.vtu").find("Name=\"a&lt;b&amp;&quot;c\""), std::string::npos);
}

// Requirement: a grid whose sizes contradict each other is refused by name and leaves no file behind.
TEST(Vtu, RefusesContradictions) {
  TemporaryFolder folder;
  auto const refused = [&](Grid const& g, std::string const& expected) {
    try {
      write_vtu(folder / "bad.vtu", g);
      ADD_FAILURE() << "accepted: " << expected;
    } catch (core::Error const& e) {
      EXPECT_EQ(e.failure, core::Failure::run);
      EXPECT_NE(std::string(e.what()).find(expected), std::string::npos) << e.what();
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.name()));
  };
  Grid g = small_grid();
  g.cell_data[1].components = 3;
  refused(g, "array 'stress' has 8 values for 4 cells of 3 components");
  g = small_grid();
  g.point_data[0].components = 0;
  refused(g, "array 'displacement'");
  g = small_grid();
  g.connectivity[3] = 4;
  refused(g, "names point 4 of 4");
  g = small_grid();
  g.offsets.back() = 9;
  refused(g, "the last cell ends at 9 of 10");
  g = small_grid();
  g.offsets[0] = 8;
  refused(g, "cell offsets decrease");
  g = small_grid();
  g.types.pop_back();
  refused(g, "4 cell offsets but 3 cell types");
}

} // namespace
} // namespace fissura::output
