#pragma once
// One frame of lines and triangles as VTK's poly data (.vtp), which filters of ParaView such as Tube take
// at once.
#include <string>

#include "fissura/output/grid.hpp"

namespace fissura::output {

/// Vertices, lines and polylines, triangles, in this order, as poly data numbers them. Throws as write_vtu(),
/// also for cells of another kind or order.
void write_vtp(std::string const& path, Grid const& grid);

} // namespace fissura::output
