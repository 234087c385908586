#pragma once
// Single values: from the tree with a check, and back to TOML text. A reading that fails has told the reader
// why.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fissura/core/vec3.hpp"
#include "fissura/deck/reader.hpp"
#include "fissura/units/units.hpp"

namespace fissura::deck {

/// What a value is called in messages, and what it may be.
struct Wanted {
  std::string_view name;
  Range range{};
  units::Dimension dimension = units::Dimension::none;

  Wanted(std::string_view name_) : name(name_) {} // NOLINT: reads as a name
  Wanted(std::string_view name_, units::Dimension d) : name(name_), dimension(d) {}
  Wanted(Key const& key) : name(key.name), range(key.range), dimension(key.dimension) {} // NOLINT
};

std::optional<std::string> read_text(Reader&, Node const&, Wanted const&);
std::optional<bool> read_flag(Reader&, Node const&, Wanted const&);
std::optional<double> read_number(Reader&, Node const&, Wanted const&);
std::optional<long> read_integer(Reader&, Node const&, Wanted const&);
/// A text with a unit of wanted.dimension -> SI; for Dimension::none the same as read_number.
std::optional<double> read_quantity(Reader&, Node const&, Wanted const&);
/// The index of the word in `words`.
std::optional<std::size_t> read_word(Reader&, Node const&, Wanted const&,
                                     std::vector<std::string_view> const& words);
std::optional<int> read_axis(Reader&, Node const&, Wanted const&);
/// A name that may stand in a file name, a CSV head or a list.
std::optional<std::string> read_name(Reader&, Node const&, Wanted const&);
/// An array with `size` items (any number from 1 to `most` if size is 0); null if it is none.
Node const* read_array(Reader&, Node const&, Wanted const&, std::size_t size, std::size_t most = 100000);
std::optional<Vec3> read_quantities(Reader&, Node const&, Wanted const&);
/// Three pure numbers, not all zero, scaled to length 1.
std::optional<Vec3> read_direction(Reader&, Node const&, Wanted const&);
std::optional<std::vector<Vec3>> read_points(Reader&, Node const&, Wanted const&, std::size_t size,
                                             std::size_t most = 100000);
std::optional<std::vector<std::string>> read_texts(Reader&, Node const&, Wanted const&);

// TOML text of values.
std::string write_text(std::string_view value);
std::string write_flag(bool value);
std::string write_number(double value);
std::string write_quantity(double value, units::Dimension dimension);
std::string write_axis(int axis);
std::string write_quantities(Vec3 value, units::Dimension dimension);
std::string write_direction(Vec3 value);
std::string write_points(std::vector<Vec3> const& points);
std::string write_texts(std::vector<std::string> const& texts);
/// "a, b, c"
std::string joined(std::vector<std::string> const& items);
/// "[a, b, c]"
std::string write_array(std::vector<std::string> const& items);

} // namespace fissura::deck
