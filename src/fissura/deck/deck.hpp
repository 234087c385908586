#pragma once
// The deck: a TOML file whose values carry units -> model::Case, with all errors of one pass, and back to
// text.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fissura/model/case.hpp"

namespace fissura::deck {

/// Reads a deck. `overrides` are `key.path=value` texts of --set, an array index being a number
/// (`concrete.0.penalty=60`); the value is TOML, and a bare word becomes a text.
/// Throws core::InputError with every finding (file:line:column, what was expected, the nearest key), or
/// core::Error with Failure::io where the file cannot be read.
model::Case read_case(std::filesystem::path const& file, std::vector<std::string> const& overrides = {});

/// The same from a text; `name` stands in messages, and its folder is where a mesh file is looked for.
model::Case read_case_text(std::string_view text, std::string const& name,
                           std::vector<std::string> const& overrides = {});

/// How a load changes in time, as the value of its key: `"0.2 m/s"`, `{value = "1 mm", over = "5 ms"}`. `key`
/// is displacement, velocity, force, traction or acceleration. Throws core::InputError.
model::Curve read_load_curve(std::string_view value, std::string const& key);

/// A deck with every value of the case, defaults included, that reads back to the same case. The mesh file is
/// named by its full path, so the echo can be read from any folder.
std::string echo(model::Case const& the_case);

/// The keys of one item of a section, `[[gauge]]` 2 say, as the echo writes them.
std::string echo_item(model::Case const& the_case, std::string_view section, std::size_t item);

/// docs/reference/deck.md, from the schema.
std::string reference_markdown();

} // namespace fissura::deck
