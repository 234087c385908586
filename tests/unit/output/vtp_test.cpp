#include <gtest/gtest.h>

#include "fissura/core/error.hpp"
#include "fissura/output/read_frame.hpp"
#include "fissura/output/vtp.hpp"
#include "support/refusal.hpp"
#include "temporary_folder.hpp"

namespace fissura::output {
namespace {

using testing::read_bytes;
using testing::TemporaryFolder;

/// A corner, a line of three points and a triangle.
Grid shapes() {
  Grid g;
  g.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}};
  g.connectivity = {3, 0, 1, 2, 0, 2, 3};
  g.offsets = {1, 4, 7};
  g.types = {cell_type::vertex, cell_type::poly_line, cell_type::triangle};
  g.cell_data = {{"bar", 1, std::vector<std::int32_t>{7, 8, 9}, "-"}};
  return g;
}

// Requirement: vertices, lines and triangles read back, each with its points, and the cells' fields in their
// order.
TEST(Vtp, ReadsBack) {
  TemporaryFolder const folder;
  write_vtp(folder / "a.vtp", shapes());
  FrameFile const file(folder / "a.vtp");
  EXPECT_EQ(file.points(), 4u);
  EXPECT_EQ(file.cells(), 3u);
  EXPECT_EQ(file.cell_list("Verts").connectivity, (std::vector<std::int64_t>{3}));
  EXPECT_EQ(file.cell_list("Lines").connectivity, (std::vector<std::int64_t>{0, 1, 2}));
  EXPECT_EQ(file.cell_list("Lines").offsets, (std::vector<std::int64_t>{3}));
  EXPECT_EQ(file.cell_list("Polys").connectivity, (std::vector<std::int64_t>{0, 2, 3}));
  EXPECT_EQ(file.cell_list("Strips").size(), 0u);
  EXPECT_EQ(file.integers("CellData", "bar"), (std::vector<std::int64_t>{7, 8, 9}));
}

// Requirement: names stand as VTK writes text: the number of each byte, a zero after each name.
TEST(Vtp, WritesNames) {
  TemporaryFolder const folder;
  Grid g = shapes();
  g.names = {{"bar_names", {"ab", "", "\xc3\xa9"}}};
  write_vtp(folder / "a.vtp", g);
  std::string const file = read_bytes(folder / "a.vtp");
  EXPECT_NE(
      file.find(
          "<Array type=\"String\" Name=\"bar_names\" NumberOfTuples=\"3\" format=\"ascii\">97 98 0 0 195 "
          "169 0 </Array>"),
      std::string::npos)
      << file.substr(0, 600);
}

// Requirement: cells in another order than the one in which poly data numbers them, and cells it has no place
// for, are refused, since their fields would belong to others.
TEST(Vtp, RefusesCellsOutOfOrder) {
  TemporaryFolder const folder;
  auto const message = [&](Grid const& g) {
    return support::refusal(core::Failure::run, [&] { write_vtp(folder / "a.vtp", g); });
  };
  Grid g = shapes();
  g.types = {cell_type::triangle, cell_type::poly_line, cell_type::triangle};
  EXPECT_NE(message(g).find("poly data has its vertices first, then lines, then triangles"),
            std::string::npos);
  g.types.back() = cell_type::tetrahedron;
  g.types.front() = cell_type::vertex;
  EXPECT_NE(message(g).find("poly data has no cells of type 10"), std::string::npos);
}

} // namespace
} // namespace fissura::output
