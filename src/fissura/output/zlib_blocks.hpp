#pragma once
// The compressed form of one array in VTK's XML files.
#include <cstddef>
#include <string>
#include <string_view>

namespace fissura::output {

/// Bytes as vtkZLibDataCompressor lays them out with header_type UInt64: number of blocks, size of a block,
/// size of the last block if it is not full (else 0), compressed size of each block, then the blocks.
std::string zlib_blocks(std::string_view bytes, std::size_t block_size = std::size_t{1} << 17);

} // namespace fissura::output
