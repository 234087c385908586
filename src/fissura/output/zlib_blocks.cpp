#include "fissura/output/zlib_blocks.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>
#include <zlib.h>

#include "fissura/core/ensure.hpp"

namespace fissura::output {

std::string zlib_blocks(std::string_view bytes, std::size_t block_size) {
  std::size_t const blocks = (bytes.size() + block_size - 1) / block_size;
  std::vector<std::uint64_t> header(3 + blocks);
  header[0] = blocks;
  header[1] = block_size;
  header[2] = bytes.size() % block_size;
  std::size_t const header_bytes = header.size() * sizeof(std::uint64_t);

  std::string out(header_bytes, '\0');
  std::vector<Bytef> packed(::compressBound(block_size));
  for (std::size_t b = 0; b < blocks; ++b) {
    std::string_view const block = bytes.substr(b * block_size, block_size);
    uLongf size = packed.size();
    // Level 1: a frame must not hold up the run; higher levels save a few per cent on doubles and cost far
    // more.
    int const status = ::compress2(packed.data(), &size, reinterpret_cast<Bytef const*>(block.data()),
                                   block.size(), Z_BEST_SPEED);
    core::ensure(status == Z_OK, ::zError(status));
    header[3 + b] = size;
    out.append(reinterpret_cast<char const*>(packed.data()), size);
  }
  std::memcpy(out.data(), header.data(), header_bytes);
  return out;
}

} // namespace fissura::output
