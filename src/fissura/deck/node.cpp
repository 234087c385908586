#include "fissura/deck/node.hpp"

#include <fmt/core.h>

namespace fissura::deck {

Node const* Node::find(std::string_view wanted) const {
  if (kind != Kind::table) return nullptr;
  for (auto const& item : items)
    if (item.key == wanted) return &item;
  return nullptr;
}

Node* Node::find(std::string_view wanted) {
  return const_cast<Node*>(static_cast<Node const*>(this)->find(wanted));
}

std::string_view kind_name(Node::Kind kind) {
  switch (kind) {
  case Node::Kind::text:
    return "a text";
  case Node::Kind::integer:
    return "a whole number";
  case Node::Kind::number:
    return "a number";
  case Node::Kind::flag:
    return "true or false";
  case Node::Kind::array:
    return "an array";
  case Node::Kind::table:
    return "a table";
  case Node::Kind::date:
    return "a date or time of day";
  }
  return "a value";
}

std::string shown(Node const& node) {
  constexpr std::size_t longest = 60;
  switch (node.kind) {
  case Node::Kind::text: {
    if (node.text.size() <= longest) return fmt::format("\"{}\"", node.text);
    std::size_t cut = longest; // never inside a multi-byte character
    while (cut > 0 && (static_cast<unsigned char>(node.text[cut]) & 0xC0U) == 0x80U) --cut;
    return fmt::format("\"{}...\"", node.text.substr(0, cut));
  }
  case Node::Kind::integer:
    return fmt::format("{}", node.integer);
  case Node::Kind::number:
    return fmt::format("{}", node.number);
  case Node::Kind::flag:
    return node.flag ? "true" : "false";
  default:
    return std::string(kind_name(node.kind));
  }
}

} // namespace fissura::deck
