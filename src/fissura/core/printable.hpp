#pragma once
// Text from files, names and paths on its way to a terminal.
#include <string>
#include <string_view>

namespace fissura::core {

/// The text with everything that a terminal would obey instead of show (control characters, also those of
/// Latin-1; marks that turn the direction of writing; bytes that are no UTF-8) as \x1b, \x9b, \u202e. Line
/// breaks and tabs stay.
std::string printable(std::string_view text);

/// The same for a name within a line: line breaks and tabs are shown as \x0a and \x09 too.
std::string printable_line(std::string_view text);

} // namespace fissura::core
