#pragma once
// Cells with their fields at one time, on the way to a file.
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fissura/core/vec3.hpp"

namespace fissura::output {

/// The numbers of VTK for the shapes used here.
namespace cell_type {
inline constexpr std::uint8_t vertex = 1, line = 3, poly_line = 4, triangle = 5, tetrahedron = 10;
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

/// What the whole numbers of a field stand for: number i is called names[i].
struct Names {
  std::string name; ///< "bar_names"
  std::vector<std::string> names;
};

struct Grid {
  std::vector<Vec3> points;               ///< [m]
  std::vector<std::int64_t> connectivity; ///< point indices of all cells, one cell after the other
  std::vector<std::int64_t> offsets;      ///< per cell: where it ends in connectivity
  std::vector<std::uint8_t> types;        ///< per cell: its cell_type
  std::vector<Array> point_data, cell_data;
  std::optional<double> time{}; ///< [s]; written as TimeValue, where VTK's readers look for it
  std::vector<Names> names{};   ///< only in .vtp: readers of .vtu (meshio) refuse text
};

} // namespace fissura::output
