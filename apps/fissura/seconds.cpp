#include "seconds.hpp"

#include <charconv>
#include <cmath>

#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/units/units.hpp"

namespace fissura::app {

namespace {

double checked(std::string const& option, std::string const& text, double value) {
  if (std::isfinite(value) && value >= 0) return value;
  throw core::Error(core::Failure::input,
                    fmt::format("{} must be a time of 0 s or more, not `{}`", option, text));
}

} // namespace

double seconds(std::string const& option, std::string const& text) {
  double value = 0;
  auto const* const end = text.data() + text.size();
  if (auto const read = std::from_chars(text.data(), end, value); read.ec == std::errc() && read.ptr == end)
    return checked(option, text, value);
  try {
    return checked(option, text, units::to_si(text, units::Dimension::time));
  } catch (core::Error const& e) {
    throw core::Error(e.failure, fmt::format("{}: {}", option, e.what()));
  }
}

} // namespace fissura::app
