#pragma once
// One frame of cells with their fields as a VTK unstructured grid (.vtu): appended raw data in zlib blocks,
// which ParaView, VisIt, meshio and tools/fissura_io.py read.
#include <string>

#include "fissura/output/grid.hpp"

namespace fissura::output {

/// Throws core::Error(Failure::run) if the sizes of the grid contradict each other, naming the array; throws
/// core::Error(Failure::io) if the file cannot be written. The file appears whole or not at all.
void write_vtu(std::string const& path, Grid const& grid);

} // namespace fissura::output
