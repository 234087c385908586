#pragma once
// How bars slip at cracks: `slip_reduction`, `crack_spacing` and `l_cr`, keys of [[bar]] and of [[cage]].
#include <fmt/core.h>

#include "fissura/deck/fields.hpp"
#include "fissura/units/decimal.hpp"

namespace fissura::deck {

/// Adds the keys for a record with the fields slip_reduction, crack_spacing, l_cr_from and l_cr.
template <class T> void slip_keys(Fields<T>& f, std::string doc_of_crack_spacing, std::string doc_of_l_cr) {
  using model::CrackLength, model::SlipReduction;
  using Written = std::optional<std::string>;
  f.word("slip_reduction", &T::slip_reduction,
         {{"paper", SlipReduction::paper}, {"consistent", SlipReduction::consistent}},
         "How the next crack reduces the slip at a crack: by Eq. 26 of the paper, with `l_cr`, which makes "
         "cracked bars "
         "stiffer than steel; or so that the mean strain between cracks tends to the strain at the cracks as "
         "these come "
         "closer, with `crack_spacing`, and closed cracks strain the bar as the concrete.");
  auto const read_spacing = [](Reader& r, Node const& n, Key const& k, T& record) {
    if (n.kind == Node::Kind::text && units::leading_number(n.text).empty()) {
      if (!read_word(r, n, k, {"automatic"}))
        r.error(n, fmt::format("`{}` may also be a length, e.g. \"150 mm\"", k.name));
      record.crack_spacing = 0;
      return;
    }
    record.crack_spacing = read_quantity(r, n, k).value_or(0);
  };
  auto const write_spacing = [](T const& record) -> Written {
    return record.crack_spacing > 0 ? write_quantity(record.crack_spacing, units::Dimension::length)
                                    : write_text("automatic");
  };
  f.custom("crack_spacing", "`automatic` or a length", std::move(doc_of_crack_spacing), read_spacing,
           write_spacing)
      .of(units::Dimension::length)
      .positive()
      .echoed_if([](T const& record) { return record.slip_reduction == SlipReduction::consistent; });
  auto const read_l_cr = [](Reader& r, Node const& n, Key const& k, T& record) {
    if (n.kind == Node::Kind::text && units::leading_number(n.text).empty()) {
      auto const word = read_word(r, n, k, {"automatic", "element_size"});
      if (!word) r.error(n, fmt::format("`{}` may also be a length, e.g. \"100 mm\"", k.name));
      record.l_cr_from = word && *word == 1 ? CrackLength::element_size : CrackLength::automatic;
      return;
    }
    record.l_cr_from = CrackLength::given;
    record.l_cr = read_quantity(r, n, k).value_or(0);
  };
  auto const write_l_cr = [](T const& record) -> Written {
    if (record.l_cr_from == CrackLength::given) return write_quantity(record.l_cr, units::Dimension::length);
    return write_text(record.l_cr_from == CrackLength::automatic ? "automatic" : "element_size");
  };
  f.custom("l_cr", "`automatic`, `element_size` or a length", std::move(doc_of_l_cr), read_l_cr, write_l_cr)
      .of(units::Dimension::length)
      .positive()
      .echoed_if([](T const& record) { return record.slip_reduction == SlipReduction::paper; });
}

/// Each length belongs to one of the two reductions.
template <class T> void check_slip_keys(Reader& reader, T const& record) {
  if (!reader.good(&record, {"slip_reduction"})) return;
  bool const paper = record.slip_reduction == model::SlipReduction::paper;
  if (!paper && reader.given(&record, "l_cr"))
    reader.error(
        reader.place(&record, "l_cr"),
        "`l_cr` belongs to slip_reduction = \"paper\"; with \"consistent\" leave it out: the mesh says which "
        "length of bar a crack stands for (`crack_spacing`, the distance of cracks, may be given)");
  if (paper && reader.given(&record, "crack_spacing"))
    reader.error(reader.place(&record, "crack_spacing"),
                 "`crack_spacing` belongs to slip_reduction = \"consistent\"; with \"paper\" give `l_cr`");
}

} // namespace fissura::deck
