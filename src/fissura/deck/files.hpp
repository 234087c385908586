#pragma once
// Files that a deck names.
#include <optional>
#include <string>

#include "fissura/deck/reader.hpp"

namespace fissura::deck {

/// The full path of a file named relative to the folder of the deck. Reports, with `what` it is ("mesh file")
/// and the table that holds `allow_outside`, a file that is missing or lies outside that folder without
/// leave.
std::string resolve_file(Reader& reader, core::Place const& place, std::string const& written,
                         bool allow_outside, std::string const& what, std::string const& table);

/// [time, value] or [value], numbered from 1; the time is 0 where it is left out.
void read_columns(Reader&, Node const&, Key const&, std::string const& value, int& time_column,
                  int& value_column);

/// "mm": the factor to SI; `example` stands in the message.
std::optional<double> read_unit(Reader&, Node const&, Key const&, units::Dimension,
                                std::string const& example);

} // namespace fissura::deck
