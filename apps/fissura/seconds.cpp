#include "seconds.hpp"

#include <charconv>

#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/units/units.hpp"

namespace fissura::app {

double seconds(std::string const& option, std::string const& text) {
  double value = 0;
  auto const* const end = text.data() + text.size();
  if (auto const read = std::from_chars(text.data(), end, value); read.ec == std::errc() && read.ptr == end)
    return value;
  try {
    return units::to_si(text, units::Dimension::time);
  } catch (core::Error const& e) {
    throw core::Error(e.failure, fmt::format("{}: {}", option, e.what()));
  }
}

} // namespace fissura::app
