#pragma once
// A 64-bit fingerprint of bytes (xxHash), for the state hash of a run.
#define XXH_INLINE_ALL
#include <cstddef>
#include <cstdint>

#include <xxhash.h>

namespace fissura::core {

inline std::uint64_t hash_bytes(void const* data, std::size_t size, std::uint64_t seed) {
  return XXH3_64bits_withSeed(data, size, seed);
}

} // namespace fissura::core
