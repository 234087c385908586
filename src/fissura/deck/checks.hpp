#pragma once
// Checks across the sections of a deck: names that refer to each other, and what the run as a whole needs.
#include "fissura/deck/reader.hpp"

namespace fissura::deck {

/// Gives unnamed items the names bar_1, bar_2, ... of their sections.
void name_the_unnamed(model::Case& the_case);

void check_case(Reader& reader);

} // namespace fissura::deck
