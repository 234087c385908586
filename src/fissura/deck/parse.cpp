// The one place that knows the TOML library.
// Its internal assertions are turned into exceptions: an unforeseen text must never end the program.
#include <stdexcept>
#include <string>

namespace fissura::deck {
[[noreturn]] inline void parser_assertion(char const* expression) {
  throw std::logic_error(std::string("the TOML parser gave up (") + expression + ")");
}
} // namespace fissura::deck
#undef NDEBUG
#define TOML_ASSERT(expr) ((expr) ? void() : ::fissura::deck::parser_assertion(#expr))
#define TOML_MAX_NESTED_VALUES 24
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

#include "fissura/deck/node.hpp"
#include "fissura/deck/scan.hpp"

namespace fissura::deck {
namespace {

core::Place place_of(toml::source_region const& region, std::string const& file) {
  return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

bool has_control_character(std::string_view text) {
  return std::any_of(text.begin(), text.end(),
                     [](char c) { return (c >= 0 && c < 0x20 && c != '\n' && c != '\t') || c == 0x7F; });
}

Node convert(toml::node const& from, std::string const& file);

void convert_table(toml::table const& from, Node& to, std::string const& file) {
  for (auto const& [key, value] : from) {
    Node item = convert(value, file);
    item.key = std::string(key.str());
    item.key_place = place_of(key.source(), file);
    // A table made by a dotted header or key has no place of its own.
    if (item.place.line == 0) item.place = item.key_place;
    if (has_control_character(item.key) || item.key.size() > 200)
      throw core::InputError(item.key_place, "this key holds control characters or is too long");
    to.items.push_back(std::move(item));
  }
  // The library sorts by key; a user thinks in the order of writing.
  std::stable_sort(to.items.begin(), to.items.end(), [](Node const& a, Node const& b) {
    return std::tie(a.key_place.line, a.key_place.column) < std::tie(b.key_place.line, b.key_place.column);
  });
}

void convert_text(std::string const& from, Node& to) {
  if (has_control_character(from)) throw core::InputError(to.place, "this text holds a control character");
  to.kind = Node::Kind::text;
  to.text = from;
}

Node convert(toml::node const& from, std::string const& file) {
  Node to;
  to.place = place_of(from.source(), file);
  switch (from.type()) {
  case toml::node_type::table:
    convert_table(*from.as_table(), to, file);
    break;
  case toml::node_type::array:
    to.kind = Node::Kind::array;
    for (auto const& item : *from.as_array()) to.items.push_back(convert(item, file));
    break;
  case toml::node_type::string:
    convert_text(from.as_string()->get(), to);
    break;
  case toml::node_type::integer:
    to.kind = Node::Kind::integer;
    to.integer = from.as_integer()->get();
    to.number = static_cast<double>(to.integer);
    break;
  case toml::node_type::floating_point:
    to.kind = Node::Kind::number;
    to.number = from.as_floating_point()->get();
    break;
  case toml::node_type::boolean:
    to.kind = Node::Kind::flag;
    to.flag = from.as_boolean()->get();
    break;
  default:
    to.kind = Node::Kind::date;
  }
  return to;
}

} // namespace

Node parse(std::string_view text, std::string const& file) {
  check_bytes(text, file);
  try {
    toml::table const table = toml::parse(text, file);
    Node root;
    root.place = {file};
    convert_table(table, root, file);
    return root;
  } catch (toml::parse_error const& e) {
    throw core::InputError(place_of(e.source(), file), fmt::format("not valid TOML: {}", e.description()));
  } catch (std::logic_error const& e) {
    throw core::InputError({file}, fmt::format("not valid TOML: {}", e.what()));
  }
}

} // namespace fissura::deck
