// `--set key.path=value`: changes the tree before it is read, so an override passes every check of the deck.
#include <fmt/core.h>

#include <charconv>
#include <optional>

#include "fissura/deck/node.hpp"
#include "fissura/deck/scan.hpp"

namespace fissura::deck {
namespace {

using Path = std::vector<std::string>;

void set_place(Node& node, core::Place const& place) {
  node.place = node.key_place = place;
  for (auto& item : node.items) set_place(item, place);
}

Node parse_value(std::string const& text, core::Place const& place) {
  Node value;
  try {
    Node root = parse("value = " + text, place.file);
    // A line break would smuggle in further keys; more than one item means it did.
    if (root.items.size() != 1) throw core::InputError(place, "give one value");
    value = std::move(root.items.front());
  } catch (core::InputError const&) {
    check_bytes(text, place.file);
    if (text.find('\n') != std::string::npos) throw core::InputError(place, "give one value on one line");
    value.kind = Node::Kind::text;
    value.text = text;
  }
  set_place(value, place);
  return value;
}

Path split(std::string_view path) {
  Path parts(1);
  for (char const c : path) {
    if (c == '.')
      parts.emplace_back();
    else if (c != ' ')
      parts.back() += c;
  }
  return parts;
}

std::optional<std::size_t> as_index(std::string const& part) {
  std::size_t index = 0;
  auto const result = std::from_chars(part.data(), part.data() + part.size(), index);
  if (part.empty() || result.ec != std::errc{} || result.ptr != part.data() + part.size())
    return std::nullopt;
  return index;
}

Node& array_item(Node& array, std::string const& part, std::string const& parent, core::Place const& place) {
  auto const index = as_index(part);
  if (!index)
    throw core::InputError(place, fmt::format("`{}` is an array: name the item by its number, e.g. {}.0.{}",
                                              parent, parent, part));
  if (*index >= array.items.size())
    throw core::InputError(place, fmt::format("`{}` has {} items, numbered from 0; there is no {}", parent,
                                              array.items.size(), part));
  return array.items[*index];
}

/// The item of a table or array that a part of the path names; a table gets a new item where it has none.
Node& child(Node& node, std::string const& part, std::string const& parent, core::Place const& place) {
  if (node.kind == Node::Kind::array) return array_item(node, part, parent, place);
  if (node.kind != Node::Kind::table)
    throw core::InputError(place,
                           fmt::format("`{}` is {}, it has no `{}`", parent, kind_name(node.kind), part));
  if (Node* found = node.find(part)) return *found;
  Node fresh;
  fresh.key = part;
  fresh.place = fresh.key_place = place;
  node.items.push_back(std::move(fresh));
  return node.items.back();
}

} // namespace

void apply_override(Node& root, std::string const& override_text) {
  core::Place const place{"--set " + override_text};
  check_bytes(override_text, "--set");
  auto const equals = override_text.find('=');
  if (equals == std::string::npos)
    throw core::InputError(place, "expected key.path=value, e.g. run.end_time=\"1 s\"");
  Path const path = split(std::string_view(override_text).substr(0, equals));
  if (path.size() > static_cast<std::size_t>(deepest_key))
    throw core::InputError(place, "the path is too deep");
  Node value = parse_value(override_text.substr(equals + 1), place);

  Node* node = &root;
  std::string parent = "the deck";
  for (auto const& part : path) {
    if (part.empty()) throw core::InputError(place, "a part of the path is empty; expected key.path=value");
    node = &child(*node, part, parent, place);
    parent = part;
  }
  value.key = node->key;
  value.key_place = place;
  *node = std::move(value);
}

} // namespace fissura::deck
