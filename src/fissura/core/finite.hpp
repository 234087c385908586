#pragma once
// Bit-level test for infinities and NaN: holds under every compiler flag.
#include <bit>
#include <cstdint>

namespace fissura::core {

constexpr bool is_finite(double x) {
  return (std::bit_cast<std::uint64_t>(x) & 0x7ff0'0000'0000'0000ULL) != 0x7ff0'0000'0000'0000ULL;
}

} // namespace fissura::core
