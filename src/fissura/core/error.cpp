#include "fissura/core/error.hpp"

#include <fmt/core.h>

namespace fissura::core {

std::string to_string(Place const& place) {
  if (place.line <= 0) return place.file;
  if (place.column <= 0) return fmt::format("{}:{}", place.file, place.line);
  return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

namespace {
std::string join(std::vector<Diagnostic> const& diagnostics) {
  std::string text;
  for (auto const& d : diagnostics) {
    if (!text.empty()) text += '\n';
    std::string const place = to_string(d.place);
    text +=
        place.empty() ? fmt::format("error: {}", d.message) : fmt::format("{}: error: {}", place, d.message);
  }
  return text;
}
} // namespace

InputError::InputError(std::vector<Diagnostic> diagnostics_)
    : Error(Failure::input, join(diagnostics_)), diagnostics(std::move(diagnostics_)) {}

} // namespace fissura::core
