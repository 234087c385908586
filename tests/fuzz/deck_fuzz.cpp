// Requirement: whatever bytes a case file holds, reading it ends in a case or in a core::Error, never in a
// crash; and the echo of every case that was read is a deck that reads.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "fissura/core/error.hpp"
#include "fissura/deck/deck.hpp"
#include "memory_limit.hpp"

namespace {
std::optional<fissura::model::Case> read(std::string_view text) {
  try {
    return fissura::deck::read_case_text(text, "fuzz.toml");
  } catch (fissura::core::Error const&) {
    return std::nullopt;
  }
}
} // namespace

/// udunits forgets a name it has read (a copy as long as that name) when the unit turns out to make no sense.
extern "C" char const* __lsan_default_suppressions() { // NOLINT: the name is the sanitizer's
  return "leak:utlex";
}

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::optional<fissura::model::Case> the_case;
  fissura::fuzz::read_within_limit(size, [&] {
    the_case = read({reinterpret_cast<char const*>(data), size});
  });
  // An error here escapes and counts as a crash: the program would have refused its own text.
  if (the_case) fissura::deck::read_case_text(fissura::deck::echo(*the_case), "echo.toml");
  return 0;
}
