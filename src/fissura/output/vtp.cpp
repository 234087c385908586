#include "fissura/output/vtp.hpp"

#include <array>
#include <fmt/core.h>

#include "fissura/output/vtk_file.hpp"

namespace fissura::output {

namespace {

/// In the order of the cells of a file.
enum class Part { vertices, lines, strips, triangles };
constexpr std::array part_names{"Verts", "Lines", "Strips", "Polys"};

Part part_of(std::string const& path, std::uint8_t type) {
  switch (type) {
  case cell_type::vertex:
    return Part::vertices;
  case cell_type::line:
  case cell_type::poly_line:
    return Part::lines;
  case cell_type::triangle:
    return Part::triangles;
  default:
    refuse_grid(path, fmt::format("poly data has no cells of type {}", type));
  }
}

struct Cells {
  std::vector<std::int64_t> connectivity, offsets;
};

std::array<Cells, part_names.size()> sorted(std::string const& path, Grid const& grid) {
  std::array<Cells, part_names.size()> parts;
  auto last = Part::vertices;
  std::int64_t begin = 0;
  for (std::size_t c = 0; c < grid.types.size(); ++c) {
    Part const part = part_of(path, grid.types[c]);
    if (part < last) refuse_grid(path, "poly data has its vertices first, then lines, then triangles");
    last = part;
    Cells& cells = parts[static_cast<std::size_t>(part)];
    for (; begin < grid.offsets[c]; ++begin)
      cells.connectivity.push_back(grid.connectivity[static_cast<std::size_t>(begin)]);
    cells.offsets.push_back(static_cast<std::int64_t>(cells.connectivity.size()));
  }
  return parts;
}

} // namespace

void write_vtp(std::string const& path, Grid const& grid) {
  check_grid(path, grid);
  auto const parts = sorted(path, grid);
  VtkFile file("PolyData");
  file.add_frame_data(grid);
  pugi::xml_node piece = file.add_piece();
  piece.append_attribute("NumberOfPoints") = static_cast<unsigned long long>(grid.points.size());
  for (std::size_t i = 0; i < parts.size(); ++i)
    piece.append_attribute(fmt::format("NumberOf{}", part_names[i]).c_str()) =
        static_cast<unsigned long long>(parts[i].offsets.size());
  file.add_fields(piece, grid);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    pugi::xml_node node = piece.append_child(part_names[i]);
    file.add(node, "connectivity", 1, parts[i].connectivity);
    file.add(node, "offsets", 1, parts[i].offsets);
  }
  file.save(path);
}

} // namespace fissura::output
