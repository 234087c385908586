// {plane = "x", at = "0 m"} and its kin: where something is.
#include <fmt/core.h>

#include "fissura/deck/fields.hpp"

namespace fissura::deck {
namespace {

using model::Selector;
using Kind = Selector::Kind;
using Written = std::optional<std::string>;
using units::Dimension;

constexpr std::array<std::string_view, 6> kinds{"all", "group", "plane", "box", "point", "line"};

std::string listed_kinds() {
  return listed({kinds.begin(), kinds.end()});
}

void read_all(Reader& r, Node const& n, Key const& k, Selector& s) {
  auto const value = read_flag(r, n, k);
  if (value && !*value) r.error(n, "`all` can only be true; leave it out otherwise");
  s.kind = Kind::all;
}

void read_group(Reader& r, Node const& n, Key const& k, Selector& s) {
  s.group = read_name(r, n, k).value_or("");
  s.kind = Kind::group;
}

void read_plane(Reader& r, Node const& n, Key const& k, Selector& s) {
  s.axis = read_axis(r, n, k).value_or(0);
  s.kind = Kind::plane;
}

template <Kind kind> void read_two_points(Reader& r, Node const& n, Key const& k, Selector& s) {
  if (auto const points = read_points(r, n, k, 2)) {
    s.from = points->front();
    s.to = points->back();
    if (kind == Kind::line && s.from == s.to) r.error(n, "the two ends of `line` are the same point");
  }
  s.kind = kind;
}

void read_point(Reader& r, Node const& n, Key const& k, Selector& s) {
  s.from = read_quantities(r, n, k).value_or(Vec3{});
  s.kind = Kind::point;
}

template <Kind kind> Written write_two_points(Selector const& s) {
  return s.kind == kind ? Written(write_points({s.from, s.to})) : std::nullopt;
}

void check_one_kind(Reader& reader, Node const& table, void* record) {
  std::size_t given = 0;
  for (auto const kind : kinds) given += reader.given(record, kind) ? 1 : 0;
  if (given == 0) reader.error(table, fmt::format("a selector needs one of {}", listed_kinds()));
  if (given > 1)
    reader.error(table, fmt::format("a selector has only one of {}; this one has {}", listed_kinds(), given));
  bool const plane = reader.given(record, "plane"), at = reader.given(record, "at");
  if (plane && !at) reader.error(table, "`plane` needs `at`, e.g. {plane = \"x\", at = \"0 m\"}");
  if (at && !plane && given == 1) reader.error(reader.place(record, "at"), "`at` belongs to `plane` only");
}

Shape make_shape() {
  Shape shape;
  shape.name = "a selector";
  shape.doc = "Picks nodes (supports, motions, forces, gauges), boundary faces (tractions) or joints (joint "
              "regions), the "
              "latter two by their centroid. It holds exactly one of `all`, `group`, `plane`, `box`, "
              "`point`, `line`.";
  shape.finish = check_one_kind;
  auto const of = [](Kind kind) { return [kind](Selector const& s) { return s.kind == kind; }; };
  Fields<Selector> f(shape.keys);
  f.custom("all", "`true`", "Everything.", read_all, [](Selector const&) -> Written {
     return "true";
   }).echoed_if(of(Kind::all));
  f.custom("group", "a name",
           "A volume, surface, curve or point group of the mesh; a box gives its volume group. Where groups "
           "of several "
           "kinds share the name, `volume:`, `surface:`, `curve:` or `point:` before it says which.",
           read_group, [](Selector const& s) -> Written { return write_text(s.group); })
      .echoed_if(of(Kind::group));
  f.custom("plane", "`x`, `y` or `z`", "The plane normal to this axis, with `at`.", read_plane,
           [](Selector const& s) -> Written { return write_axis(s.axis); })
      .echoed_if(of(Kind::plane));
  f.quantity("at", &Selector::at, Dimension::length, "Coordinate of the plane.").echoed_if(of(Kind::plane));
  f.custom("box", "two opposite corners", "All that lies inside.", read_two_points<Kind::box>,
           write_two_points<Kind::box>)
      .of(Dimension::length)
      .echoed_if(of(Kind::box));
  f.custom("point", "three lengths", "The node nearest to this point; with `tolerance` all nodes that near.",
           read_point,
           [](Selector const& s) -> Written { return write_quantities(s.from, Dimension::length); })
      .of(Dimension::length)
      .echoed_if(of(Kind::point));
  f.custom("line", "two ends", "All that lies on the segment.", read_two_points<Kind::line>,
           write_two_points<Kind::line>)
      .of(Dimension::length)
      .echoed_if(of(Kind::line));
  f.quantity("tolerance", &Selector::tolerance, Dimension::length,
             "Distance that still counts; 1e-6 of the largest extent of the mesh unless said.")
      .not_negative()
      .echoed_if([](Selector const& s) { return s.tolerance > 0; });
  return shape;
}

} // namespace

Shape const& selector_shape() {
  static Shape const shape = make_shape();
  return shape;
}

void read_selector(Reader& reader, Node const& node, Key const& key, Selector& selector) {
  selector.place = node.place;
  if (node.kind == Node::Kind::table) return reader.read_shape(selector_shape(), node, &selector);
  std::string const cure = node.kind == Node::Kind::text ? fmt::format("{{group = {}}}", shown(node))
                                                         : "{plane = \"x\", at = \"0 m\"}";
  reader.error(node, fmt::format("`{}` must be a selector, e.g. {}, not {}", key.name, cure, shown(node)));
}

std::string write_shape(Shape const& shape, void const* record) {
  std::vector<std::string> items;
  for (auto const& key : shape.keys)
    if (auto const value = key.write(record)) items.push_back(fmt::format("{} = {}", key.name, *value));
  return "{" + joined(items) + "}";
}

std::string write_selector(Selector const& selector) {
  return write_shape(selector_shape(), &selector);
}

std::string write_curve(model::Curve const& curve, Dimension dimension) {
  CurveDraft const draft{curve, dimension};
  return write_shape(curve_shape(), &draft);
}

} // namespace fissura::deck
