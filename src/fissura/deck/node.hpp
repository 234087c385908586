#pragma once
// A parsed deck as a plain tree that remembers where everything was written. The TOML library is seen by
// parse.cpp only.
#include <string>
#include <string_view>
#include <vector>

#include "fissura/core/error.hpp"

namespace fissura::deck {

struct Node {
  enum class Kind { text, integer, number, flag, array, table, date };
  Kind kind = Kind::table;
  std::string text; ///< kind text
  long long integer = 0;
  double number = 0; ///< kinds number and integer
  bool flag = false;
  std::vector<Node> items; ///< of an array, or of a table in the order they were written
  std::string key;         ///< of an item of a table
  core::Place place;       ///< of the value
  core::Place key_place;   ///< of an item of a table

  /// The item of a table with this key, or null.
  Node const* find(std::string_view wanted) const;
  Node* find(std::string_view wanted);
};

/// "a text", "a number", ...: for messages.
std::string_view kind_name(Node::Kind kind);

/// The value as the user would recognise it in a message, shortened.
std::string shown(Node const& node);

/// Parses TOML. Refuses control characters, bad UTF-8, very large and very deep texts before the library sees
/// them. Throws core::InputError with file:line:column.
Node parse(std::string_view text, std::string const& file);

/// Applies one `key.path=value` of the command line; an array index is a number. The value is TOML, else a
/// text. Throws core::InputError that quotes the override.
void apply_override(Node& root, std::string const& override_text);

} // namespace fissura::deck
