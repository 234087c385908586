// Requirement: whatever bytes an .inp file holds, reading and checking it ends in a mesh or in a core::Error.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fissura/core/error.hpp"
#include "fissura/mesh/check.hpp"
#include "fissura/mesh/inp_reader.hpp"
#include "memory_limit.hpp"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  fissura::fuzz::read_within_limit(size, [&] {
    try {
      auto const mesh =
          fissura::mesh::parse_inp({reinterpret_cast<char const*>(data), size}, "fuzz.inp", 1e-3, 300'000);
      fissura::mesh::check_mesh(mesh);
    } catch (fissura::core::Error const&) {
    }
  });
  return 0;
}
