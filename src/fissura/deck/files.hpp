#pragma once
// Files that a deck names.
#include <string>

#include "fissura/deck/reader.hpp"

namespace fissura::deck {

/// The full path of a file named relative to the folder of the deck. Reports, with `what` it is ("mesh file")
/// and the table that holds `allow_outside`, a file that is missing or lies outside that folder without
/// leave.
std::string resolve_file(Reader& reader, core::Place const& place, std::string const& written,
                         bool allow_outside, std::string const& what, std::string const& table);

} // namespace fissura::deck
