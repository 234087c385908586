#include "numbers.hpp"

#include <charconv>
#include <cmath>

#include <fmt/core.h>

namespace fissura::app {

CLI::Validator number_within(double least, double most, std::string const& or_word) {
  auto const check = [=](std::string& text) -> std::string {
    if (!or_word.empty() && text == or_word) return {};
    double value = 0;
    auto const* const end = text.data() + text.size();
    auto const read = std::from_chars(text.data(), end, value);
    bool const is_number = read.ec == std::errc() && read.ptr == end && std::isfinite(value);
    if (is_number && value >= least && value <= most) return {};
    return fmt::format("{} is no number from {} to {}{}", text, least, most,
                       or_word.empty() ? "" : fmt::format(", nor `{}`", or_word));
  };
  return CLI::Validator(check, fmt::format("{} - {}", least, most), "number");
}

} // namespace fissura::app
