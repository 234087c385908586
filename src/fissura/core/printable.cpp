#include "fissura/core/printable.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fmt/format.h>

namespace fissura::core {

namespace {

/// Length of the UTF-8 sequence at the start of the text and its number; length 0: there is none.
struct Sign {
  std::size_t length = 0;
  std::uint32_t number = 0;
};

Sign first_sign(std::string_view text) {
  auto const byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  unsigned char const first = byte(0);
  if (first < 0x80) return {1, first};
  std::size_t const length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return {};
  std::uint32_t number = first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {};
    number = number << 6 | (byte(i) & 0x3F);
  }
  constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
  bool const surrogate = number >= 0xD800 && number <= 0xDFFF;
  return number < least[length] || surrogate || number > 0x10FFFF ? Sign{} : Sign{length, number};
}

bool is_obeyed(std::uint32_t number) {
  return number < 0x20 || (number >= 0x7F && number < 0xA0) || number == 0x200E || number == 0x200F ||
         (number >= 0x2028 && number <= 0x202E) || (number >= 0x2066 && number <= 0x2069);
}

std::string shown(std::string_view text, std::string_view kept) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    Sign const sign = first_sign(text);
    if (sign.length == 0)
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    else if (!is_obeyed(sign.number) ||
             (sign.length == 1 && kept.find(text.front()) != std::string_view::npos))
      out += text.substr(0, sign.length);
    else
      out +=
          sign.number < 0x100 ? fmt::format("\\x{:02x}", sign.number) : fmt::format("\\u{:04x}", sign.number);
    text.remove_prefix(std::max<std::size_t>(sign.length, 1));
  }
  return out;
}

} // namespace

std::string printable(std::string_view text) {
  return shown(text, "\n\t");
}

std::string printable_line(std::string_view text) {
  return shown(text, "");
}

} // namespace fissura::core
