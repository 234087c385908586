#pragma once
// Bit-level tests for infinities and NaN: they hold under every compiler flag.
#include <bit>
#include <cstddef>
#include <cstdint>

namespace fissura::core {

inline constexpr std::uint64_t exponent_bits = 0x7ff0'0000'0000'0000ULL;

constexpr bool is_finite(double x) {
  return (std::bit_cast<std::uint64_t>(x) & exponent_bits) != exponent_bits;
}

/// Whether all of `count` numbers are finite. Adding one to an exponent of ones carries into the sign bit: no
/// comparison, so that the loop runs in packs.
inline bool all_finite(double const* x, std::size_t count) {
  std::uint64_t carried = 0;
  for (std::size_t i = 0; i < count; ++i)
    carried |= (std::bit_cast<std::uint64_t>(x[i]) & exponent_bits) + (std::uint64_t{1} << 52U);
  return carried >> 63U == 0;
}

} // namespace fissura::core
