#pragma once
// A first look at the bytes of a deck, before any parser: what could hurt the parser or the reader is refused
// here.
#include <string>
#include <string_view>

namespace fissura::deck {

inline constexpr std::size_t largest_deck = 16U << 20U; ///< bytes
inline constexpr int most_values = 1 << 16;             ///< a value takes some 400 bytes once it is read
inline constexpr int deepest_key = 16;                  ///< parts of a dotted key a.b.c

/// Throws core::InputError at the first control character, bad UTF-8, over-long text, over-deep dotted key or
/// value too many.
void check_bytes(std::string_view text, std::string const& file);

} // namespace fissura::deck
