// [[plane]], [[impactor]] and [[initial_velocity]].
#include <fmt/core.h>

#include <algorithm>

#include "fissura/deck/fields.hpp"

namespace fissura::deck {
namespace {

using model::ImpactorSpec;
using model::InitialVelocitySpec;
using model::PlaneSpec;
using ImpactorShape = ImpactorSpec::Shape;
using Written = std::optional<std::string>;
using units::Dimension;

constexpr char const* friction_doc = "Friction mu between it and concrete.";

Section plane_section() {
  Section s = many_section("plane", &model::Case::planes,
                           "A rigid half space that never moves: a floor, a wall. It acts on free faces of "
                           "tets, at the boundary and where cracks have let go.");
  Fields<PlaneSpec> f(s.keys);
  f.name("name", &PlaneSpec::name, "Gauges refer to it.").default_is("`plane_1`, `plane_2`, ...");
  f.point("point", &PlaneSpec::point, "A point of its surface.").required();
  f.direction("normal", &PlaneSpec::normal, "Out of the rigid half space, into the free one.").required();
  f.number("friction", &PlaneSpec::friction, friction_doc).not_negative();
  return s;
}

/// The keys of the shapes, and the shapes each belongs to.
struct ShapeKey {
  std::string_view key;
  std::vector<ImpactorShape> shapes;
};
std::vector<ShapeKey> const& shape_keys() {
  static std::vector<ShapeKey> const table{{"centre", {ImpactorShape::sphere}},
                                           {"radius", {ImpactorShape::sphere, ImpactorShape::cylinder}},
                                           {"from", {ImpactorShape::cylinder, ImpactorShape::box}},
                                           {"to", {ImpactorShape::cylinder, ImpactorShape::box}}};
  return table;
}

bool belongs(std::string_view key, ImpactorShape shape) {
  for (auto const& k : shape_keys())
    if (k.key == key) return std::find(k.shapes.begin(), k.shapes.end(), shape) != k.shapes.end();
  return true;
}

std::vector<std::pair<std::string_view, ImpactorShape>> const& shapes() {
  static std::vector<std::pair<std::string_view, ImpactorShape>> const words{
      {"sphere", ImpactorShape::sphere}, {"cylinder", ImpactorShape::cylinder}, {"box", ImpactorShape::box}};
  return words;
}

void check_shape(Reader& reader, Node const& table, ImpactorSpec const& impactor) {
  std::string_view word;
  for (auto const& [w, shape] : shapes())
    if (shape == impactor.shape) word = w;
  for (auto const& k : shape_keys()) {
    bool const given = reader.given(&impactor, k.key), needed = belongs(k.key, impactor.shape);
    if (needed && !given) reader.error(table, fmt::format("a {} needs `{}`", word, k.key));
    if (given && !needed)
      reader.error(reader.place(&impactor, k.key), fmt::format("`{}` has no meaning for a {}", k.key, word));
  }
  if (!reader.given(&impactor, "from") || !reader.given(&impactor, "to") ||
      !reader.good(&impactor, {"from", "to"}))
    return;
  Vec3 const span = impactor.to - impactor.from;
  if (impactor.shape == ImpactorShape::cylinder && !(norm(span) > 0))
    reader.error(reader.place(&impactor, "to"), "`from` and `to`, the ends of the axis, are the same point");
  if (impactor.shape == ImpactorShape::box && !(span.x != 0 && span.y != 0 && span.z != 0))
    reader.error(reader.place(&impactor, "to"),
                 "`from` and `to` must differ in x, y and z: they are opposite corners of the box");
}

void finish_impactor(Reader& reader, Node const& table, void* record) {
  auto const& impactor = *static_cast<ImpactorSpec const*>(record);
  if (reader.good(record, {"shape"})) check_shape(reader, table, impactor);
  if (!reader.good(record, {"velocity", "moves"})) return;
  for (int i = 0; i < 3; ++i)
    if (!impactor.moves[static_cast<std::size_t>(i)] && impactor.velocity[i] != 0)
      reader.error(reader.place(record, "velocity"),
                   fmt::format("`velocity` has a component along {}, which `moves` does not name", "xyz"[i]));
}

void read_moves(Reader& r, Node const& n, Key const& k, ImpactorSpec& impactor) {
  if (!read_array(r, n, k, 0, 3)) return;
  impactor.moves = {false, false, false};
  for (auto const& item : n.items) {
    auto const axis = read_axis(r, item, k);
    if (!axis) continue;
    auto& moves = impactor.moves[static_cast<std::size_t>(*axis)];
    if (moves) r.error(item, "`moves` names this axis twice");
    moves = true;
  }
}

Written write_moves(ImpactorSpec const& impactor) {
  std::vector<std::string> axes;
  for (int i = 0; i < 3; ++i)
    if (impactor.moves[static_cast<std::size_t>(i)]) axes.push_back(write_axis(i));
  return write_array(axes);
}

Section impactor_section() {
  Section s = many_section("impactor", &model::Case::impactors,
                           "A rigid body that strikes concrete. It moves as a point mass and does not turn, "
                           "as a guided drop weight "
                           "does; gravity acts on it where [gravity] is given. Impactors and planes do not "
                           "touch each other. It is felt "
                           "at points half a tet's edge apart: it must not be smaller than that.");
  s.finish = finish_impactor;
  auto const of_shape = [](std::string_view key) {
    return [key](ImpactorSpec const& i) { return belongs(key, i.shape); };
  };
  Fields<ImpactorSpec> f(s.keys);
  f.name("name", &ImpactorSpec::name, "Gauges refer to it.").default_is("`impactor_1`, `impactor_2`, ...");
  f.word("shape", &ImpactorSpec::shape, shapes(), "Which of the following keys it needs.").required();
  f.point("centre", &ImpactorSpec::centre, "Of a sphere.").default_is("none").echoed_if(of_shape("centre"));
  f.quantity("radius", &ImpactorSpec::radius, Dimension::length, "Of a sphere or cylinder.")
      .positive()
      .default_is("none")
      .echoed_if(of_shape("radius"));
  f.point("from", &ImpactorSpec::from, "One end of a cylinder's axis, or one corner of a box along x, y, z.")
      .default_is("none")
      .echoed_if(of_shape("from"));
  f.point("to", &ImpactorSpec::to, "The other end, or the opposite corner.")
      .default_is("none")
      .echoed_if(of_shape("to"));
  f.quantity("mass", &ImpactorSpec::mass, Dimension::mass, "Its mass.").positive().required();
  f.vector("velocity", &ImpactorSpec::velocity, Dimension::velocity, "At t = 0.");
  f.custom("moves", "an array of `x`, `y`, `z`", "The components it moves in; a guide holds the others.",
           read_moves, write_moves);
  f.number("friction", &ImpactorSpec::friction, friction_doc).not_negative();
  return s;
}

Section initial_velocity_section() {
  Section s =
      many_section("initial_velocity", &model::Case::initial_velocities,
                   "Concrete and bars in motion at t = 0. Of several that pick the same tet the last one "
                   "holds; supports and motions that act from the start go before it.");
  Fields<InitialVelocitySpec> f(s.keys);
  f.selector("where", &InitialVelocitySpec::where,
             "Tets, by their centroid or volume group; `plane`, `point` and `line` pick nodes.")
      .required();
  f.vector("velocity", &InitialVelocitySpec::velocity, Dimension::velocity, "Their velocity.").required();
  return s;
}

} // namespace

std::vector<Section> rigid_sections() {
  return {plane_section(), impactor_section(), initial_velocity_section()};
}

} // namespace fissura::deck
