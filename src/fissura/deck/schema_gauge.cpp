// [[gauge]] and [[stop]].
#include <fmt/core.h>

#include <algorithm>

#include "fissura/deck/fields.hpp"

namespace fissura::deck {
namespace {

using model::GaugeSpec;
using model::StopSpec;
using Kind = GaugeSpec::Kind;
using Written = std::optional<std::string>;
using units::Dimension;

std::vector<std::pair<std::string_view, Kind>> const& kinds() {
  static std::vector<std::pair<std::string_view, Kind>> const words{
      {"displacement", Kind::displacement},
      {"velocity", Kind::velocity},
      {"reaction", Kind::reaction},
      {"force", Kind::force},
      {"bar", Kind::bar},
      {"crack_width", Kind::crack_width},
      {"mean_strain", Kind::mean_strain},
      {"contact_force", Kind::contact_force},
      {"contact_impulse", Kind::contact_impulse},
      {"impactor_displacement", Kind::impactor_displacement},
      {"impactor_velocity", Kind::impactor_velocity}};
  return words;
}

std::vector<std::string_view> const bar_quantities{"stress", "joint_stress",    "joint_strain",
                                                   "slip",   "normalised_slip", "dowel_force"};

/// The keys a kind cannot do without, and the kinds a key has a meaning for.
struct Use {
  std::string_view key;
  std::vector<Kind> needed, allowed;
};
std::vector<Use> const& uses() {
  static std::vector<Use> const table{
      {"where", {Kind::displacement, Kind::velocity}, {}},
      {"axis",
       {Kind::displacement, Kind::velocity, Kind::reaction, Kind::contact_force, Kind::contact_impulse,
        Kind::impactor_displacement, Kind::impactor_velocity},
       {Kind::force}},
      {"of",
       {Kind::reaction, Kind::force, Kind::contact_force, Kind::contact_impulse, Kind::impactor_displacement,
        Kind::impactor_velocity},
       {}},
      {"bar", {Kind::bar}, {}},
      {"at", {Kind::bar}, {}},
      {"copy", {}, {Kind::bar}},
      {"quantity", {}, {Kind::bar}},
      {"line", {Kind::crack_width, Kind::mean_strain}, {}},
  };
  return table;
}

bool has(std::vector<Kind> const& list, Kind kind) {
  return std::find(list.begin(), list.end(), kind) != list.end();
}

bool used(std::string_view key, Kind kind) {
  for (auto const& use : uses())
    if (use.key == key) return has(use.needed, kind) || has(use.allowed, kind);
  return true;
}

std::string_view word_of(Kind kind) {
  for (auto const& [word, k] : kinds())
    if (k == kind) return word;
  return {};
}

void finish_gauge(Reader& reader, Node const& table, void* record) {
  auto& gauge = *static_cast<GaugeSpec*>(record);
  if (gauge.kind == Kind::bar && gauge.quantity.empty()) gauge.quantity = bar_quantities.front();
  if (!reader.good(record, {"kind"})) return;
  for (auto const& use : uses()) {
    bool const given = reader.given(record, use.key), needed = has(use.needed, gauge.kind);
    if (needed && !given)
      reader.error(table, fmt::format("a gauge of kind \"{}\" needs `{}`", word_of(gauge.kind), use.key));
    if (given && !needed && !has(use.allowed, gauge.kind))
      reader.error(
          reader.place(record, use.key),
          fmt::format("`{}` has no meaning for a gauge of kind \"{}\"", use.key, word_of(gauge.kind)));
  }
}

void read_line(Reader& r, Node const& n, Key const& k, GaugeSpec& gauge) {
  auto const ends = read_points(r, n, k, 2);
  if (!ends) return;
  gauge.from = ends->front();
  gauge.to = ends->back();
  if (gauge.from == gauge.to) r.error(n, "the two ends of `line` are the same point");
}

void read_bar_quantity(Reader& r, Node const& n, Key const& k, GaugeSpec& gauge) {
  if (auto const i = read_word(r, n, k, bar_quantities)) gauge.quantity = bar_quantities[*i];
}

Section gauge_section() {
  Section s = many_section(
      "gauge", &model::Case::gauges,
      "A column of history.csv. Its kind says which keys it needs: `displacement`, `velocity`: `where`, "
      "`axis`; "
      "`reaction`: `of`, `axis`; `force`: `of`; `bar`: `bar`, `at`; `crack_width`, `mean_strain`: `line`; "
      "`contact_force`, `contact_impulse`, `impactor_displacement`, `impactor_velocity`: `of`, `axis`.");
  s.finish = finish_gauge;
  auto const if_used = [](std::string_view key) {
    return [key](GaugeSpec const& g) { return used(key, g.kind); };
  };
  Fields<GaugeSpec> f(s.keys);
  f.name("name", &GaugeSpec::name, "Head of the column; stops refer to it.").required();
  f.word("kind", &GaugeSpec::kind, kinds(),
         "What is measured. `crack_width`: sum of the openings along the line; `mean_strain`: elongation of "
         "the line over its length; `contact_force`: of rigid bodies on the concrete; `contact_impulse`: its "
         "integral over time.")
      .required();
  f.selector("where", &GaugeSpec::where, "Nodes; the mean of their values is read.")
      .default_is("none")
      .echoed_if(if_used("where"));
  f.axis("axis", &GaugeSpec::axis, "The component.").echoed_if(if_used("axis"));
  f.texts(
      "of", &GaugeSpec::of,
      "Supports and motions (`reaction`), forces and tractions (`force`), planes and impactors "
      "(`contact_force`, "
      "`contact_impulse`): their sum is read. `impactor_displacement`, `impactor_velocity`: one impactor.");
  f.name("bar", &GaugeSpec::bar, "Name of the bar.");
  f.integer("copy", &GaugeSpec::copy,
            "Which of its copies, from 0: `count` of them, for each line of its `curve`.")
      .echoed_if(if_used("copy"));
  f.custom("quantity", listed(bar_quantities),
           "What is read: of the bar element, or of the bar joint, next to `at`.", read_bar_quantity,
           [](GaugeSpec const& g) -> Written { return write_text(g.quantity); })
      .default_is("`stress`")
      .echoed_if(if_used("quantity"));
  f.point("at", &GaugeSpec::from, "Place along the bar.").default_is("none").echoed_if(if_used("at"));
  f.custom("line", "two ends", "The line measured along.", read_line,
           [](GaugeSpec const& g) -> Written {
             return write_points({g.from, g.to});
           })
      .of(Dimension::length)
      .default_is("none")
      .echoed_if(if_used("line"));
  f.number("factor", &GaugeSpec::factor, "Multiplies the reading: sign, symmetry.");
  f.name("zero_at", &GaugeSpec::zero_at, "Readings are relative to the one at the start of this stage.");
  return s;
}

/// A threshold in SI as a plain number, or with a unit that fits the gauge.
std::optional<double> read_threshold(Reader& r, Node const& n, Key const& k, StopSpec const& stop) {
  if (n.kind != Node::Kind::text) return read_number(r, n, k);
  for (auto const& gauge : r.the_case.gauges)
    if (gauge.name == stop.gauge) {
      Wanted wanted(k.name, dimension_of(gauge));
      wanted.range = k.range;
      return read_quantity(r, n, wanted);
    }
  return std::nullopt; // the unknown gauge is reported where names are checked
}

void finish_stop(Reader& reader, Node const& table, void* record) {
  bool const falls = reader.given(record, "falls_to");
  if (!falls && !reader.given(record, "above") && !reader.given(record, "below"))
    reader.error(table, "[[stop]] needs `above`, `below` or `falls_to`");
  if (reader.given(record, "after") && !falls)
    reader.error(reader.place(record, "after"), "`after` belongs to `falls_to`");
}

Section stop_section() {
  Section s = many_section("stop", &model::Case::stops,
                           "Ends the run when a gauge passes a threshold, or has fallen from its peak. "
                           "Thresholds are SI numbers or carry a unit.");
  s.finish = finish_stop;
  std::string const threshold = "a number [SI] or a quantity of the gauge";
  Fields<StopSpec> f(s.keys);
  f.name("gauge", &StopSpec::gauge, "Name of the gauge.").required();
  f.custom(
       "above", threshold, "Stops when the gauge exceeds this.",
       [](Reader& r, Node const& n, Key const& k, StopSpec& stop) {
         stop.above = read_threshold(r, n, k, stop).value_or(0);
         stop.has_above = true;
       },
       [](StopSpec const& stop) -> Written { return write_number(stop.above); })
      .default_is("none")
      .echoed_if([](StopSpec const& stop) { return stop.has_above; });
  f.custom(
       "below", threshold, "Stops when the gauge falls below this.",
       [](Reader& r, Node const& n, Key const& k, StopSpec& stop) {
         stop.below = read_threshold(r, n, k, stop).value_or(0);
         stop.has_below = true;
       },
       [](StopSpec const& stop) -> Written { return write_number(stop.below); })
      .default_is("none")
      .echoed_if([](StopSpec const& stop) { return stop.has_below; });
  f.number("falls_to", &StopSpec::falls_to,
           "Stops when |gauge|, averaged over five rows of history, has fallen to this share of its largest "
           "mean.")
      .range({0, 1, true, true})
      .default_is("none")
      .echoed_if([](StopSpec const& stop) { return stop.falls_to > 0; });
  f.custom(
       "after", threshold, "`falls_to` waits until the largest |gauge| exceeds this.",
       [](Reader& r, Node const& n, Key const& k, StopSpec& stop) {
         stop.after = read_threshold(r, n, k, stop).value_or(0);
       },
       [](StopSpec const& stop) -> Written { return write_number(stop.after); })
      .not_negative()
      .echoed_if([](StopSpec const& stop) { return stop.falls_to > 0; });
  return s;
}

} // namespace

Dimension dimension_of(GaugeSpec const& gauge) {
  switch (gauge.kind) {
  case Kind::displacement:
  case Kind::crack_width:
  case Kind::impactor_displacement:
    return Dimension::length;
  case Kind::velocity:
  case Kind::impactor_velocity:
    return Dimension::velocity;
  case Kind::reaction:
  case Kind::force:
  case Kind::contact_force:
    return Dimension::force;
  case Kind::contact_impulse:
    return Dimension::impulse;
  case Kind::mean_strain:
    return Dimension::none;
  case Kind::bar:
    break;
  }
  if (gauge.quantity == "slip") return Dimension::length;
  if (gauge.quantity == "dowel_force") return Dimension::force;
  if (gauge.quantity == "joint_strain" || gauge.quantity == "normalised_slip") return Dimension::none;
  return Dimension::pressure;
}

std::vector<Section> gauge_sections() {
  return {gauge_section(), stop_section()};
}

} // namespace fissura::deck
