#include "fissura/output/vtu.hpp"

#include "fissura/output/vtk_file.hpp"

namespace fissura::output {

void write_vtu(std::string const& path, Grid const& grid) {
  check_grid(path, grid);
  VtkFile file("UnstructuredGrid");
  file.add_frame_data(grid);
  pugi::xml_node piece = file.add_piece();
  piece.append_attribute("NumberOfPoints") = static_cast<unsigned long long>(grid.points.size());
  piece.append_attribute("NumberOfCells") = static_cast<unsigned long long>(grid.types.size());
  file.add_fields(piece, grid);
  pugi::xml_node cells = piece.append_child("Cells");
  file.add(cells, "connectivity", 1, grid.connectivity);
  file.add(cells, "offsets", 1, grid.offsets);
  file.add(cells, "types", 1, grid.types);
  file.save(path);
}

} // namespace fissura::output
