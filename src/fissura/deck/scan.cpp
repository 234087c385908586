#include "fissura/deck/scan.hpp"

#include <fmt/core.h>

#include "fissura/core/error.hpp"

namespace fissura::deck {
namespace {

/// Where the scan stands. Columns count characters, not bytes, as editors do.
struct Cursor {
  std::string_view text;
  std::string const& file;
  std::size_t at = 0;
  int line = 1, column = 1;

  bool done() const { return at >= text.size(); }
  bool sees(std::string_view s) const { return text.substr(at, s.size()) == s; }
  unsigned char byte(std::size_t ahead = 0) const {
    return at + ahead < text.size() ? static_cast<unsigned char>(text[at + ahead]) : 0;
  }
  [[noreturn]] void refuse(std::string message) const {
    throw core::InputError({file, line, column}, std::move(message));
  }
};

/// Length of the UTF-8 character at the cursor; 0 if the bytes are none (overlong, surrogate, cut short).
int character_length(Cursor const& c) {
  unsigned const b = c.byte();
  if (b < 0x80) return 1;
  int const length = b >= 0xF0 ? 4 : b >= 0xE0 ? 3 : 2;
  if (b < 0xC2 || b > 0xF4) return 0;
  unsigned code = b & (0xFFU >> (length + 1));
  for (int i = 1; i < length; ++i) {
    unsigned const next = c.byte(static_cast<std::size_t>(i));
    if ((next & 0xC0U) != 0x80U) return 0;
    code = code << 6U | (next & 0x3FU);
  }
  bool const overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  bool const surrogate = code >= 0xD800 && code <= 0xDFFF;
  return overlong || surrogate || code > 0x10FFFF ? 0 : length;
}

bool is_forbidden_control(Cursor const& c) {
  unsigned const b = c.byte();
  if (b == '\n' || b == '\t') return false;
  if (b == '\r') return c.byte(1) != '\n';
  return b < 0x20 || b == 0x7F;
}

void step(Cursor& c) {
  if (is_forbidden_control(c))
    c.refuse(fmt::format("control character 0x{:02X}; a deck is plain UTF-8 text", c.byte()));
  int const length = character_length(c);
  if (length == 0)
    c.refuse(fmt::format("byte 0x{:02X} is not valid UTF-8; save the deck as UTF-8", c.byte()));
  bool const new_line = c.byte() == '\n';
  c.at += static_cast<std::size_t>(length);
  c.column = new_line ? 1 : c.column + 1;
  c.line += new_line ? 1 : 0;
}

void step_over(Cursor& c, std::size_t characters) {
  for (; characters > 0 && !c.done(); --characters) step(c);
}

/// Steps over a string that starts at the cursor. One that never ends is left to the parser to report.
void skip_string(Cursor& c) {
  std::string_view quote = c.byte() == '"' ? "\"" : "'";
  if (c.sees("\"\"\"")) quote = "\"\"\"";
  if (c.sees("'''")) quote = "'''";
  bool const escapes = quote.front() == '"';
  step_over(c, quote.size());
  while (!c.done() && !c.sees(quote)) {
    if (quote.size() == 1 && c.byte() == '\n') return;
    if (escapes && c.byte() == '\\') step(c);
    if (!c.done()) step(c);
  }
  step_over(c, quote.size());
  for (int more = 0; quote.size() == 3 && more < 2 && c.byte() == static_cast<unsigned char>(quote.front());
       ++more)
    step(c); // up to two quotes may stand before the three that end it
}

/// A byte after which a quote begins a string for toml++ too. Elsewhere it would read on in what this scan
/// takes for a string, and characters beyond ASCII are undefined behaviour for it there.
bool goes_before_string(unsigned char b) {
  return b == '\n' || b == '=' || b == ',' || b == '[' || b == '{';
}

bool ends_dotted_key(unsigned char b) {
  return b == '\n' || b == '=' || b == ',' || b == '[' || b == ']' || b == '{' || b == '}' || b == '#';
}

/// A byte that a value or a table may follow.
bool begins_value(unsigned char b) {
  return b == '=' || b == ',' || b == '[' || b == '{';
}

} // namespace

void check_bytes(std::string_view text, std::string const& file) {
  if (text.size() > largest_deck)
    throw core::InputError({file}, fmt::format("the deck is larger than {} MiB", largest_deck >> 20U));
  Cursor c{text, file};
  int dots = 0, values = 0;
  unsigned char before = '\n'; // the last byte that is no blank
  while (!c.done()) {
    unsigned char const b = c.byte();
    if (b == '"' || b == '\'') {
      if (!goes_before_string(before))
        c.refuse(
            "a quote where no text can begin: a text stands alone behind `=`, a comma or a bracket, and keys "
            "need no quotes");
      skip_string(c);
      before = b;
      continue;
    }
    if (b == '#')
      while (!c.done() && c.byte() != '\n') step(c);
    if (c.done()) return;
    if (begins_value(c.byte())) ++values;
    if (ends_dotted_key(c.byte())) {
      if (c.byte() == '=' || c.byte() == ']') values += dots; // a table for each part
      dots = 0;
    }
    if (values > most_values)
      c.refuse(fmt::format("more than {} values; long tables belong in a record file", most_values));
    // Bare keys and values are ASCII; beyond it toml++ 3.3 runs into undefined behaviour (U+FB26 to U+FEFE).
    bool const byte_order_mark = c.at == 0 && c.sees("\xEF\xBB\xBF");
    if (c.byte() >= 0x80 && !byte_order_mark)
      c.refuse("a character that may stand only in quotes or in a comment");
    if (c.byte() == '.' && ++dots >= deepest_key)
      c.refuse(fmt::format("more than {} parts in a dotted key", deepest_key));
    if (c.byte() != ' ' && c.byte() != '\t' && c.byte() != '\r' && !byte_order_mark) before = c.byte();
    step(c);
  }
}

} // namespace fissura::deck
