// {speed = "0.1 m/s", turn = "5 ms", to = [...]}: a motion to and fro between readings of gauges.
#include <fmt/core.h>

#include "fissura/deck/fields.hpp"

namespace fissura::deck {
namespace {

using model::PathSpec;
using Target = PathSpec::Target;
using Written = std::optional<std::string>;
using units::Dimension;

void read_value(Reader& r, Node const& n, Key const& k, Target& target) {
  target.place = n.place;
  if (n.kind == Node::Kind::text)
    target.written = n.text; // its unit is checked once the gauges are known
  else
    target.value = read_number(r, n, k).value_or(0);
}

Shape make_target_shape() {
  Shape shape;
  shape.name = "a target of a path";
  Fields<Target> f(shape.keys);
  f.name("gauge", &Target::gauge, "Name of the gauge.").required();
  f.custom("value", "a number [SI] or a quantity of the gauge", "The reading to go to.", read_value,
           [](Target const& t) -> Written { return write_number(t.value); })
      .required();
  return shape;
}

Shape const& target_shape() {
  static Shape const shape = make_target_shape();
  return shape;
}

void read_targets(Reader& r, Node const& n, Key const& k, PathSpec& path) {
  if (!read_array(r, n, k, 0, 10000)) return;
  for (auto const& item : n.items) {
    Target target;
    target.place = item.place;
    if (item.kind != Node::Kind::table) {
      r.error(
          item,
          fmt::format("a target of `to` must be a table, e.g. {{gauge = \"force\", value = \"0 N\"}}, not {}",
                      shown(item)));
      continue;
    }
    r.read_shape(target_shape(), item, &target);
    path.targets.push_back(std::move(target));
  }
}

Written write_targets(PathSpec const& path) {
  std::vector<std::string> items;
  for (auto const& target : path.targets) items.push_back(write_shape(target_shape(), &target));
  return write_array(items);
}

void finish_path(Reader& reader, Node const& table, void* record) {
  bool const shared = reader.given(record, "of");
  for (auto const key : {"speed", "turn", "to", "then"}) {
    if (shared && reader.given(record, key))
      reader.error(reader.place(record, key), fmt::format("`{}` belongs to the path that `of` names", key));
    if (!shared && !reader.given(record, key) && std::string_view(key) != "then")
      reader.error(table, fmt::format("a path needs `{}`, or `of`: the motion whose path it shares", key));
  }
  if (!shared && reader.given(record, "scale"))
    reader.error(reader.place(record, "scale"), "`scale` belongs to `of`");
}

Shape make_shape() {
  Shape shape;
  shape.name = "a path";
  shape.doc = "A motion that turns where gauges reach their targets, for cyclic tests. It moves with "
              "+`speed` while the gauge "
              "is to rise to its target and with -`speed` while it is to fall: the gauge must grow with the "
              "displacement (give "
              "it `factor = -1` if it does not). Gauges are looked at every `energy_every` steps ([run]), "
              "and what is looked at "
              "is the plain reading: where a force rings, a target near zero may be met by a ripple. The "
              "turn that follows "
              "takes `turn` and overshoots by about a third of `speed` times `turn`.";
  shape.finish = finish_path;
  auto const own = [](PathSpec const& p) { return p.of.empty(); };
  auto const shared = [](PathSpec const& p) { return !p.of.empty(); };
  Fields<PathSpec> f(shape.keys);
  f.quantity("speed", &PathSpec::speed, Dimension::velocity, "Speed between the turns.")
      .positive()
      .echoed_if(own);
  f.quantity("turn", &PathSpec::turn, Dimension::time,
             "Duration of a turn, and of the start; the velocity and the acceleration do not jump.")
      .positive()
      .echoed_if(own);
  f.custom("to", "an array of `{gauge, value}`", "The targets, in turn.", read_targets, write_targets)
      .echoed_if(own);
  f.word("then", &PathSpec::stops, {{"stop", true}, {"rest", false}},
         "After the last target the run is complete, or the motion comes to rest and the run goes on; `stop` "
         "unless "
         "said.")
      .echoed_if(own);
  f.name("of", &PathSpec::of, "Instead of the other keys: shares the path of this motion.").echoed_if(shared);
  f.number("scale", &PathSpec::scale,
           "Factor on the velocity of a shared path; -1 for a symmetric pull; 1 unless said.")
      .echoed_if(shared);
  return shape;
}

} // namespace

Shape const& path_shape() {
  static Shape const shape = make_shape();
  return shape;
}

void read_path(Reader& reader, Node const& node, Key const& key, PathSpec& path) {
  path.place = node.place;
  if (node.kind == Node::Kind::table) return reader.read_shape(path_shape(), node, &path);
  reader.error(
      node, fmt::format("`{}` must be a table, e.g. {{speed = \"0.1 m/s\", turn = \"5 ms\", to = [{{gauge = "
                        "\"force\", value = \"0 N\"}}]}}, not {}",
                        key.name, shown(node)));
}

} // namespace fissura::deck
