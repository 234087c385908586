#include <fmt/core.h>

#include "fissura/deck/deck.hpp"
#include "fissura/deck/schema.hpp"

namespace fissura::deck {

std::string echo(model::Case const& the_case) {
  std::string text = "# Every value of this run, defaults included.\n";
  model::Case copy = the_case; // the schema hands out records for reading and writing alike
  for (auto const& section : schema())
    for (std::size_t i = 0; i < section.count(copy); ++i) {
      if (!section.path.empty()) text += fmt::format("\n{}\n", title(section));
      void const* record = section.record(copy, i);
      for (auto const& key : section.keys)
        if (auto const value = key.write(record)) text += fmt::format("{} = {}\n", key.name, *value);
    }
  return text;
}

} // namespace fissura::deck
