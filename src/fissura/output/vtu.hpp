#pragma once
// One frame of cells with their fields as a VTK unstructured grid (.vtu): appended raw data in zlib blocks,
// which ParaView, VisIt and tools/fissura_io.py read.
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "fissura/core/vec3.hpp"

namespace fissura::output {

/// The numbers of VTK for the shapes used here.
namespace cell_type {
inline constexpr std::uint8_t vertex = 1, line = 3, triangle = 5, tetrahedron = 10;
}

/// Values of one field, `components` per point or cell, in point or cell order.
struct Array {
  using Values = std::variant<std::vector<float>, std::vector<double>, std::vector<std::uint8_t>,
                              std::vector<std::int32_t>, std::vector<std::int64_t>>;
  std::string name;
  int components = 1;
  Values values;
  std::string unit{}; ///< "Pa"; written as VTK's UNITS_LABEL, empty = not written
};

struct Grid {
  std::vector<Vec3> points;               ///< [m]
  std::vector<std::int64_t> connectivity; ///< point indices of all cells, one cell after the other
  std::vector<std::int64_t> offsets;      ///< per cell: where it ends in connectivity
  std::vector<std::uint8_t> types;        ///< per cell: its cell_type
  std::vector<Array> point_data, cell_data;
};

/// Throws core::Error(Failure::run) if the sizes of the grid contradict each other, naming the array; throws
/// core::Error(Failure::io) if the file cannot be written. The file appears whole or not at all.
void write_vtu(std::string const& path, Grid const& grid);

} // namespace fissura::output
