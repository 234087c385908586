// [[bar]] and [bars].
#include <fmt/core.h>

#include <algorithm>
#include <numbers>

#include "fissura/deck/cages.hpp"
#include "fissura/deck/fields.hpp"
#include "fissura/deck/slip_keys.hpp"

namespace fissura::deck {
namespace {

using model::BarSettings;
using model::BarSpec;
using Written = std::optional<std::string>;
using units::Dimension;

void check_polyline(Reader& reader, Node const& table, BarSpec const& bar) {
  bool const points = reader.given(&bar, "points"), curve = reader.given(&bar, "curve");
  if (points == curve) reader.error(table, "[[bar]] needs either `points` or `curve`");
  if (!points || !reader.good(&bar, {"points", "closed"})) return;
  auto const place = reader.place(&bar, "points");
  std::size_t const least = bar.closed ? 3 : 2;
  if (bar.points.size() < least) reader.error(place, fmt::format("`points` needs at least {} points", least));
  for (std::size_t i = 1; i < bar.points.size(); ++i)
    if (bar.points[i] == bar.points[i - 1])
      reader.error(place,
                   fmt::format("points {} and {} of `points` are the same (numbered from 0)", i - 1, i));
  if (bar.closed && bar.points.size() > 1 && bar.points.front() == bar.points.back())
    reader.error(place, "a closed bar returns to its first point by itself: leave out the last point");
}

void finish_bar(Reader& reader, Node const& table, void* record) {
  auto& bar = *static_cast<BarSpec*>(record);
  bool const diameter = reader.given(record, "diameter"), area = reader.given(record, "area");
  if (!diameter && !area) reader.error(table, "[[bar]] needs `diameter` or `area`");
  if (area && !diameter) bar.diameter = std::sqrt(4 * bar.area / std::numbers::pi);
  check_polyline(reader, table, bar);
  check_slip_keys(reader, bar);
  if (bar.count > 1 && bar.spacing == Vec3{} && reader.good(record, {"spacing", "count"}))
    reader.error(reader.place(record, "count"),
                 fmt::format("{} bars need `spacing`, the offset from one to the next", bar.count));
}

Section bar_section() {
  Section s = many_section("bar", &model::Case::bars,
                           "A reinforcing bar, or several equal ones: a polyline embedded in the mesh. A "
                           "stirrup is a closed one.");
  s.finish = finish_bar;
  // The bars of cages come last; the echo holds their cages.
  s.count = [](model::Case const& c) {
    return static_cast<std::size_t>(
        std::count_if(c.bars.begin(), c.bars.end(), [](BarSpec const& b) { return b.cage.empty(); }));
  };
  Fields<BarSpec> f(s.keys);
  f.name("name", &BarSpec::name, "Gauges refer to it.").default_is("`bar_1`, `bar_2`, ...");
  f.name("steel", &BarSpec::steel, "Name of its [[steel]].").required();
  f.quantity("diameter", &BarSpec::diameter, Dimension::length, "Diameter D: bond and dowel depend on it.")
      .positive()
      .default_is("sqrt(4 area/pi)");
  f.quantity("area", &BarSpec::area, Dimension::area, "Cross-section; a lumped bar may give both.")
      .positive()
      .default_is("pi diameter^2/4")
      .echoed_if([](BarSpec const& b) { return b.area > 0; });
  f.custom(
       "points", "an array of points", "The polyline.",
       [](Reader& r, Node const& n, Key const& k, BarSpec& bar) {
         bar.points = read_points(r, n, k, 0).value_or(std::vector<Vec3>{});
       },
       [](BarSpec const& b) -> Written { return write_points(b.points); })
      .of(Dimension::length)
      .echoed_if([](BarSpec const& b) { return !b.points.empty(); });
  f.name("curve", &BarSpec::curve,
         "Instead of points: a curve group of the mesh file. Each of its lines, a chain or a loop, is a bar; "
         "copy number k is "
         "line k mod lines, moved k / lines times by `spacing`.");
  f.flag("closed", &BarSpec::closed, "Joins the last point to the first.");
  f.integer("count", &BarSpec::count, "Number of equal bars.").range({1, 10000});
  f.point("spacing", &BarSpec::spacing, "Offset from one to the next; needed with `count`.");
  f.number("initial_strain", &BarSpec::initial_strain,
           "Imposed strain; prestress > 0 stretches the steel. Smaller than f_y/E_s.")
      .range({-0.1, 0.1});
  slip_keys(
      f,
      "With `consistent`: mean distance of the cracks that the bar itself makes, 4/3 (c + D/(7.2 rho_eff)) "
      "(fib MC2010) with cover c and effective concrete area from the mesh, or given. It says how much of "
      "the force the concrete between cracks takes.",
      "With `paper`: crack spacing seen by a bar joint: half the bar's length that belongs to it, h/2 (the "
      "paper), or given.");
  return s;
}

Section bars_section() {
  Section s = single_section("bars", &model::Case::bar_settings, "Settings of all bars.");
  Fields<BarSettings> f(s.keys);
  f.word("between_cracks", &BarSettings::between_cracks,
         {{"slip_only", model::BarBetweenCracks::slip_only}, {"elastic", model::BarBetweenCracks::elastic}},
         "Between two activated bar joints an element has no stiffness of its own, since the slip law holds "
         "its strain; `elastic` is the "
         "paper and counts it twice.");
  f.flag("dowel", &BarSettings::dowel, "Dowel action of bars across cracks.");
  return s;
}

} // namespace

std::vector<Section> bar_sections() {
  return {bar_section(), cage_section(), bars_section()};
}

} // namespace fissura::deck
