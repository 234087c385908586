// [[cage]]: "4 x 12 mm" and "8 mm / 150 mm" instead of points.
#include <fmt/core.h>

#include "fissura/deck/cages.hpp"
#include "fissura/deck/fields.hpp"
#include "fissura/deck/slip_keys.hpp"
#include "fissura/model/cage.hpp"

namespace fissura::deck {
namespace {

using model::BarLayer;
using model::CageSpec;
using model::StirrupSpec;
using Written = std::optional<std::string>;
using units::Dimension;

constexpr int most_bars = 1000; ///< in one layer

/// A length inside a longer text; reports what is wrong with it.
std::optional<double> length_in(Reader& r, Node const& n, Key const& k, std::string const& text) {
  Node part = n;
  part.text = text;
  Wanted wanted(k.name, Dimension::length);
  wanted.range = {0, HUGE_VAL, true, false};
  return read_quantity(r, part, wanted);
}

/// "4 x 12 mm"
BarLayer read_layer(Reader& r, Node const& n, Key const& k) {
  auto const wrong = [&] {
    r.error(n, fmt::format("`{}` must be a number of bars and their diameter, e.g. \"4 x 12 mm\", not {}",
                           k.name, shown(n)));
    return BarLayer{};
  };
  if (n.kind != Node::Kind::text) return wrong();
  auto const digits = n.text.find_first_not_of("0123456789");
  auto const cross = n.text.find_first_not_of(' ', digits);
  if (digits == 0 || digits > 4 || cross == std::string::npos || n.text[cross] != 'x') return wrong();
  BarLayer layer;
  layer.count = std::stoi(n.text.substr(0, digits));
  if (layer.count < 1 || layer.count > most_bars) {
    r.error(n, fmt::format("`{}`: a layer has 1 to {} bars, not {}", k.name, most_bars, layer.count));
    return {};
  }
  layer.diameter = length_in(r, n, k, n.text.substr(cross + 1)).value_or(0);
  return layer;
}

std::vector<BarLayer> read_layers(Reader& r, Node const& n, Key const& k) {
  if (n.kind != Node::Kind::array) return {read_layer(r, n, k)};
  std::vector<BarLayer> layers;
  if (!read_array(r, n, k, 0, 100)) return layers;
  for (auto const& item : n.items) layers.push_back(read_layer(r, item, k));
  return layers;
}

/// "8 mm / 150 mm"
StirrupSpec read_stirrups(Reader& r, Node const& n, Key const& k) {
  auto const slash = n.kind == Node::Kind::text ? n.text.find('/') : std::string::npos;
  if (slash == std::string::npos) {
    r.error(n, fmt::format("`{}` must be diameter and spacing, e.g. \"8 mm / 150 mm\", not {}", k.name,
                           shown(n)));
    return {};
  }
  StirrupSpec s;
  s.diameter = length_in(r, n, k, n.text.substr(0, slash)).value_or(0);
  s.spacing = length_in(r, n, k, n.text.substr(slash + 1)).value_or(0);
  return s;
}

std::string write_layer(BarLayer const& l) {
  return write_text(fmt::format("{} x {}", l.count, units::from_si(l.diameter, Dimension::length)));
}

Written write_layers(std::vector<BarLayer> const& layers) {
  std::vector<std::string> items;
  for (auto const& l : layers) items.push_back(write_layer(l));
  return write_array(items);
}

Fields<CageSpec>& layers(Fields<CageSpec>& f, std::string name, std::vector<BarLayer> CageSpec::*field,
                         std::string doc) {
  return f
      .custom(
          std::move(name), "a layer, e.g. `4 x 12 mm`, or an array of layers", std::move(doc),
          [field](Reader& r, Node const& n, Key const& k, CageSpec& c) { c.*field = read_layers(r, n, k); },
          [field](CageSpec const& c) { return write_layers(c.*field); })
      .echoed_if([field](CageSpec const& c) { return !(c.*field).empty(); });
}

Fields<CageSpec>& layer(Fields<CageSpec>& f, std::string name, BarLayer CageSpec::*field, std::string doc) {
  return f
      .custom(
          std::move(name), "a number of bars and a diameter, e.g. `8 x 16 mm`", std::move(doc),
          [field](Reader& r, Node const& n, Key const& k, CageSpec& c) { c.*field = read_layer(r, n, k); },
          [field](CageSpec const& c) -> Written { return write_layer(c.*field); })
      .echoed_if([field](CageSpec const& c) { return (c.*field).count > 0; });
}

void read_end_cover(Reader& r, Node const& n, Key const& k, CageSpec& c) {
  if (n.kind != Node::Kind::array) {
    c.end_cover[0] = c.end_cover[1] = read_quantity(r, n, k).value_or(0);
    return;
  }
  if (!read_array(r, n, k, 2)) return;
  for (std::size_t i = 0; i < 2; ++i) c.end_cover[i] = read_quantity(r, n.items[i], k).value_or(0);
}

Written write_end_cover(CageSpec const& c) {
  return write_array(
      {write_quantity(c.end_cover[0], Dimension::length), write_quantity(c.end_cover[1], Dimension::length)});
}

void check_keys_of_kind(Reader& reader, CageSpec const& c) {
  bool const beam = c.kind == CageSpec::Kind::beam;
  for (auto const key : {"bottom", "top", "sides", "up"})
    if (!beam && reader.given(&c, key))
      reader.error(reader.place(&c, key),
                   fmt::format("`{}` belongs to kind = \"beam\"; a column has `bars`", key));
  if (beam && reader.given(&c, "bars"))
    reader.error(reader.place(&c, "bars"),
                 "`bars` belongs to kind = \"column\"; a beam has `bottom`, `top` and `sides`");
}

void check_layers(Reader& reader, Node const& table, CageSpec const& c) {
  if (!reader.good(&c, {"bottom", "top", "sides", "bars", "stirrups"})) return;
  if (c.bottom.empty() && c.top.empty() && c.bars.count == 0 && c.stirrups.diameter == 0)
    reader.error(table, "[[cage]] needs `bottom` or `top` (beam), `bars` (column) or `stirrups`");
  if (c.sides.count > 0 && (c.bottom.empty() || c.top.empty()))
    reader.error(reader.place(&c, "sides"), "`sides` lie between `bottom` and `top`: give both");
  if (c.bars.count > 0 && (c.bars.count < 4 || c.bars.count % 2 != 0))
    reader.error(reader.place(&c, "bars"),
                 fmt::format("a column has an even number of bars, 4 or more, not {}", c.bars.count));
}

void check_corners(Reader& reader, CageSpec const& c) {
  if (!reader.good(&c, {"from", "to", "axis", "up"})) return;
  for (int k = 0; k < 3; ++k)
    if (c.from[k] == c.to[k])
      reader.error(
          reader.place(&c, "to"),
          fmt::format("`from` and `to` are opposite corners of the concrete member: they have the same {}",
                      "xyz"[k]));
  if (c.up >= 0 && c.up == model::axis_of(c))
    reader.error(reader.place(&c, "up"),
                 fmt::format("`up` is {}, and the member runs along {}: swap `axis` and `up`?", "xyz"[c.up],
                             "xyz"[c.up]));
}

void finish_cage(Reader& reader, Node const& table, void* record) {
  auto const& c = *static_cast<CageSpec const*>(record);
  if (!reader.good(record, {"kind"})) return;
  check_keys_of_kind(reader, c);
  check_layers(reader, table, c);
  check_corners(reader, c);
  check_slip_keys(reader, c);
}

void add_member(Fields<CageSpec>& f) {
  f.name("name", &CageSpec::name, "Begins the names of its bars: `NAME_bottom`, `NAME_stirrups`, ...")
      .default_is("`cage_1`, `cage_2`, ...");
  f.word("kind", &CageSpec::kind, {{"beam", CageSpec::Kind::beam}, {"column", CageSpec::Kind::column}},
         "A beam has layers at bottom and top; a column has bars around its section.");
  f.point("from", &CageSpec::from, "One corner of the concrete member.").required();
  f.point("to", &CageSpec::to, "The opposite corner.").required();
  f.custom(
       "axis", "`x`, `y` or `z`", "The member runs along it.",
       [](Reader& r, Node const& n, Key const& k, CageSpec& c) { c.axis = read_axis(r, n, k).value_or(-1); },
       [](CageSpec const& c) -> Written { return write_axis(c.axis); })
      .default_is("its longest side")
      .echoed_if([](CageSpec const& c) { return c.axis >= 0; });
  f.custom(
       "up", "`x`, `y` or `z`", "Points to the top of a beam.",
       [](Reader& r, Node const& n, Key const& k, CageSpec& c) { c.up = read_axis(r, n, k).value_or(-1); },
       [](CageSpec const& c) -> Written { return write_axis(c.up); })
      .default_is("`z`; `y` for members along z")
      .echoed_if([](CageSpec const& c) { return c.up >= 0; });
}

void add_steel(Fields<CageSpec>& f) {
  f.name("steel", &CageSpec::steel, "Name of the [[steel]] of its bars.").required();
  f.name("stirrup_steel", &CageSpec::stirrup_steel, "Name of the [[steel]] of its stirrups.")
      .default_is("`steel`");
  f.quantity("cover", &CageSpec::cover, Dimension::length,
             "Concrete over the outermost steel: over the stirrups, where there are some.")
      .not_negative()
      .required();
  f.custom("end_cover", "a length, or one for each end",
           "Concrete over the ends of the bars and beyond the outer stirrups; 0 for bars that reach the end.",
           read_end_cover, write_end_cover)
      .of(Dimension::length)
      .not_negative()
      .default_is("`cover`")
      .echoed_if([](CageSpec const& c) { return c.end_cover[0] >= 0 && c.end_cover[1] >= 0; });
  f.quantity("clear", &CageSpec::clear, Dimension::length,
             "Least clear distance between parallel bars and layers.")
      .not_negative()
      .default_is("20 mm, or the diameter if it is larger")
      .echoed_if([](CageSpec const& c) { return c.clear >= 0; });
}

} // namespace

Section cage_section() {
  Section s =
      many_section("cage", &model::Case::cages,
                   "The reinforcement of a straight member with a rectangular section, as it is written on a "
                   "drawing. It stands for [[bar]] tables; gauges refer to `NAME_bottom`, `NAME_bottom_2` "
                   "(the second layer), `NAME_top`, `NAME_side_1`, `NAME_row_1` (columns) and "
                   "`NAME_stirrups`, each with its copies numbered from 0. Stirrups are closed and have "
                   "sharp corners.");
  s.finish = finish_cage;
  Fields<CageSpec> f(s.keys);
  add_member(f);
  add_steel(f);
  layers(f, "bottom", &CageSpec::bottom, "Beam: the layers at the bottom, from the face inwards.");
  layers(f, "top", &CageSpec::top, "Beam: the layers at the top, from the face inwards.");
  layer(f, "sides", &CageSpec::sides, "Beam: bars on each side, evenly between bottom and top.");
  layer(f, "bars", &CageSpec::bars,
        "Column: all its bars, one in each corner and the others in pairs where the gap is widest.");
  f.custom(
       "stirrups", "a diameter and a spacing, e.g. `8 mm / 150 mm`",
       "As many as fit between the end covers; what is left over is shared by both ends.",
       [](Reader& r, Node const& n, Key const& k, CageSpec& c) { c.stirrups = read_stirrups(r, n, k); },
       [](CageSpec const& c) -> Written {
         return write_text(fmt::format("{} / {}", units::from_si(c.stirrups.diameter, Dimension::length),
                                       units::from_si(c.stirrups.spacing, Dimension::length)));
       })
      .echoed_if([](CageSpec const& c) { return c.stirrups.diameter > 0; });
  slip_keys(f, "As `crack_spacing` of [[bar]], for its longitudinal bars. Stirrups stay `automatic`.",
            "With `paper`: crack spacing seen by the joints of its longitudinal bars, as `l_cr` of [[bar]]; "
            "half the "
            "distance of the cracks one expects is a good choice. Stirrups stay `automatic`.");
  return s;
}

void make_cages(Reader& reader) {
  for (auto& cage : reader.the_case.cages) {
    bool const sound = reader.good(&cage, {"kind", "from", "to", "axis", "up", "cover", "end_cover", "clear",
                                           "bottom", "top", "sides", "bars", "stirrups"});
    if (!sound || reader.errors() > 0) continue;
    std::vector<model::CageFault> faults;
    cage.made = model::make_bars(cage, faults);
    for (auto& fault : faults) reader.error(reader.place(&cage, fault.key), std::move(fault.message));
  }
}

void hand_over_cages(model::Case& c) {
  for (auto& cage : c.cages) {
    for (auto& bar : cage.made) c.bars.push_back(std::move(bar));
    cage.made.clear();
  }
}

} // namespace fissura::deck
