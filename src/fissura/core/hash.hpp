#pragma once
// A 64-bit fingerprint of bytes (xxHash), for the state hash of a run and the checksum of checkpoints.
#include <cstddef>
#include <cstdint>
#include <memory>

struct XXH3_state_s;

namespace fissura::core {

std::uint64_t hash_bytes(void const* data, std::size_t size, std::uint64_t seed);

/// The same of bytes that come in pieces.
class Hash {
 public:
  Hash();
  ~Hash();
  void add(void const* data, std::size_t size);
  std::uint64_t value() const;

 private:
  std::unique_ptr<XXH3_state_s> state_;
};

} // namespace fissura::core
