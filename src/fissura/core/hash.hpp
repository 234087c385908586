#pragma once
// A 64-bit fingerprint of bytes (xxHash), for the state hash of a run and the checksum of checkpoints.
#define XXH_INLINE_ALL
#include <cstddef>
#include <cstdint>

#include <xxhash.h>

namespace fissura::core {

inline std::uint64_t hash_bytes(void const* data, std::size_t size, std::uint64_t seed) {
  return XXH3_64bits_withSeed(data, size, seed);
}

/// The same of bytes that come in pieces.
class Hash {
 public:
  Hash() { XXH3_64bits_reset(&state_); }
  void add(void const* data, std::size_t size) { XXH3_64bits_update(&state_, data, size); }
  std::uint64_t value() const { return XXH3_64bits_digest(&state_); }

 private:
  XXH3_state_t state_;
};

} // namespace fissura::core
