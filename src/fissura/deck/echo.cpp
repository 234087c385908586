#include <fmt/core.h>

#include "fissura/deck/deck.hpp"
#include "fissura/deck/schema.hpp"

namespace fissura::deck {

namespace {

std::string keys_of(Section const& section, void const* record) {
  std::string text;
  for (auto const& key : section.keys)
    if (auto const value = key.write(record)) text += fmt::format("{} = {}\n", key.name, *value);
  return text;
}

} // namespace

std::string echo(model::Case const& the_case) {
  std::string text = "# Every value of this run, defaults included.\n";
  model::Case copy = the_case; // the schema hands out records for reading and writing alike
  for (auto const& section : schema())
    for (std::size_t i = 0; i < section.count(copy); ++i) {
      if (!section.path.empty()) text += fmt::format("\n{}\n", title(section));
      text += keys_of(section, section.record(copy, i));
    }
  return text;
}

std::string echo_item(model::Case const& the_case, std::string_view section, std::size_t item) {
  model::Case copy = the_case;
  for (auto const& s : schema())
    if (s.path == section && item < s.count(copy)) return keys_of(s, s.record(copy, item));
  return {};
}

} // namespace fissura::deck
