#define XXH_INLINE_ALL // here alone: it takes its time, and wants a high level of optimisation
#include <xxhash.h>

#include "fissura/core/hash.hpp"

namespace fissura::core {

std::uint64_t hash_bytes(void const* data, std::size_t size, std::uint64_t seed) {
  return XXH3_64bits_withSeed(data, size, seed);
}

Hash::Hash() : state_(std::make_unique<XXH3_state_s>()) {
  XXH3_64bits_reset(state_.get());
}

Hash::~Hash() = default;

void Hash::add(void const* data, std::size_t size) {
  XXH3_64bits_update(state_.get(), data, size);
}

std::uint64_t Hash::value() const {
  return XXH3_64bits_digest(state_.get());
}

} // namespace fissura::core
