#include "fissura/units/decimal.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace fissura::units {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::size_t count_digits(std::string_view text, std::size_t from) {
  std::size_t n = 0;
  while (from + n < text.size() && is_digit(text[from + n])) ++n;
  return n;
}

struct Parts {
  std::string_view mantissa; // with its sign
  long exponent;
};

Parts split_exponent(std::string_view number) {
  auto const e = number.find_first_of("eE");
  if (e == std::string_view::npos) return {number, 0};
  auto text = number.substr(e + 1);
  if (text.front() == '+') text.remove_prefix(1);
  long exponent = 0;
  auto const result = std::from_chars(text.data(), text.data() + text.size(), exponent);
  // Beyond long: any value past the range of double gives the same answer.
  if (result.ec != std::errc{}) exponent = text.front() == '-' ? -100000 : 100000;
  return {number.substr(0, e), exponent};
}

} // namespace

std::string_view leading_number(std::string_view text) {
  std::size_t i = 0;
  if (i < text.size() && (text[i] == '+' || text[i] == '-')) ++i;
  std::size_t const whole = count_digits(text, i);
  i += whole;
  std::size_t fraction = 0;
  if (i < text.size() && text[i] == '.') {
    fraction = count_digits(text, i + 1);
    if (whole + fraction > 0) i += 1 + fraction;
  }
  if (whole + fraction == 0) return {};
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    std::size_t j = i + 1;
    if (j < text.size() && (text[j] == '+' || text[j] == '-')) ++j;
    std::size_t const digits = count_digits(text, j);
    if (digits > 0) i = j + digits;
  }
  return text.substr(0, i);
}

std::optional<double> shifted_value(std::string_view number, int exponent) {
  auto [mantissa, written] = split_exponent(number);
  if (mantissa.front() == '+') mantissa.remove_prefix(1);
  std::string const text = std::string(mantissa) + "e" + std::to_string(written + exponent);
  double value = 0;
  auto const result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc::result_out_of_range) {
    // from_chars does not tell overflow from underflow; a value below the smallest double is zero.
    if (written + exponent < 0) return 0.0;
    return std::nullopt;
  }
  if (result.ec != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string shifted_text(double value, int exponent) {
  std::array<char, 64> buffer;
  auto const end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific).ptr;
  auto const [mantissa, written] =
      split_exponent({buffer.data(), static_cast<std::size_t>(end - buffer.data())});
  bool const negative = mantissa.front() == '-';
  std::string digits;
  for (char const c : mantissa)
    if (is_digit(c)) digits += c;
  std::string text = negative ? "-" : "";
  if (digits == "0") return text + "0";
  long const point = written - exponent + 1; // digits before the decimal point
  long const size = static_cast<long>(digits.size());
  auto const zeros = [](long n) { return std::string(static_cast<std::size_t>(n), '0'); };
  if (point < -4 || point > 15) {
    text += digits.front();
    if (size > 1) text.append(".").append(digits, 1);
    return text + "e" + std::to_string(point - 1);
  }
  if (point <= 0) return text.append("0.").append(zeros(-point)).append(digits);
  if (point >= size) return text.append(digits).append(zeros(point - size));
  auto const split = static_cast<std::size_t>(point);
  return text.append(digits, 0, split).append(".").append(digits, split);
}

} // namespace fissura::units
