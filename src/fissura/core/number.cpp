#include "fissura/core/number.hpp"

#include <charconv>
#include <cmath>

namespace fissura::core {
namespace {

bool is_sign(char c) {
  return c == '+' || c == '-';
}

std::size_t digits(std::string_view text) {
  std::size_t n = 0;
  while (n < text.size() && text[n] >= '0' && text[n] <= '9') ++n;
  return n;
}

/// What is left of the text behind an exponent's letter is a whole number.
bool is_exponent(std::string_view text) {
  if (!text.empty() && is_sign(text.front())) text.remove_prefix(1);
  return !text.empty() && digits(text) == text.size();
}

} // namespace

std::optional<std::string> decimal_text(std::string_view word) {
  std::string text;
  if (!word.empty() && is_sign(word.front())) {
    if (word.front() == '-') text += '-';
    word.remove_prefix(1);
  }
  std::size_t const whole = digits(word);
  std::size_t fraction = 0, end = whole;
  if (end < word.size() && word[end] == '.') {
    fraction = digits(word.substr(end + 1));
    end += 1 + fraction;
  }
  if (whole + fraction == 0) return std::nullopt;
  text += word.substr(0, end);
  word.remove_prefix(end);
  if (word.empty()) return text;
  if (std::string_view("eEdD").find(word.front()) == std::string_view::npos || !is_exponent(word.substr(1)))
    return std::nullopt;
  return text.append("e").append(word.substr(word[1] == '+' ? 2 : 1));
}

namespace {

/// Most numbers are plain: no text is made of them.
std::optional<double> read_plain(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  std::size_t const first = !word.empty() && word.front() == '-' ? 1 : 0;
  bool const may_be =
      first < word.size() && (word[first] == '.' || (word[first] >= '0' && word[first] <= '9'));
  if (!may_be) return std::nullopt; // "inf", "+-1"
  double value = 0;
  auto const result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec != std::errc{} || result.ptr != word.data() + word.size()) return std::nullopt;
  return value;
}

} // namespace

std::optional<double> read_decimal(std::string_view word) {
  if (auto const plain = read_plain(word)) return plain;
  auto const text = decimal_text(word);
  if (!text) return std::nullopt;
  double value = 0;
  auto const result = std::from_chars(text->data(), text->data() + text->size(), value);
  if (result.ec == std::errc::result_out_of_range)
    // from_chars does not tell overflow from underflow.
    return text->find("e-") != std::string::npos ? std::optional(0.0) : std::nullopt;
  if (result.ec != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

} // namespace fissura::core
