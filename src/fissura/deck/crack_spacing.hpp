#pragma once
// `l_cr`: "automatic", "element_size" or a length; a key of [[bar]] and of [[cage]].
#include <fmt/core.h>

#include "fissura/deck/fields.hpp"
#include "fissura/units/decimal.hpp"

namespace fissura::deck {

/// Adds the key for a record with the fields crack_spacing and l_cr.
template <class T> Fields<T>& crack_spacing(Fields<T>& f, std::string doc) {
  using model::CrackSpacing;
  auto const read = [](Reader& r, Node const& n, Key const& k, T& record) {
    if (n.kind == Node::Kind::text && units::leading_number(n.text).empty()) {
      auto const word = read_word(r, n, k, {"automatic", "element_size"});
      if (!word) r.error(n, fmt::format("`{}` may also be a length, e.g. \"100 mm\"", k.name));
      record.crack_spacing = word && *word == 1 ? CrackSpacing::element_size : CrackSpacing::automatic;
      return;
    }
    record.crack_spacing = CrackSpacing::given;
    record.l_cr = read_quantity(r, n, k).value_or(0);
  };
  auto const write = [](T const& record) -> std::optional<std::string> {
    if (record.crack_spacing == CrackSpacing::given)
      return write_quantity(record.l_cr, units::Dimension::length);
    return write_text(record.crack_spacing == CrackSpacing::automatic ? "automatic" : "element_size");
  };
  return f.custom("l_cr", "`automatic`, `element_size` or a length", std::move(doc), read, write)
      .of(units::Dimension::length)
      .positive();
}

} // namespace fissura::deck
