// [[stage]], [[support]], [[motion]], [[force]], [[traction]] and [gravity].
#include <fmt/core.h>

#include "fissura/deck/fields.hpp"

namespace fissura::deck {
namespace {

using model::AbsorbingSpec;
using model::ForceSpec;
using model::GravitySpec;
using model::MotionSpec;
using model::StageSpec;
using model::SupportSpec;
using model::TractionSpec;
using Written = std::optional<std::string>;
using units::Dimension;

constexpr char const* stage_doc =
    "Stage whose start is t = 0 of the curve; the load keeps its last value afterwards.";
constexpr char const* from_start = "the start of the run";

Section stage_section() {
  Section s = many_section(
      "stage", &model::Case::stages,
      "A part of the run; stages follow each other in the order of the deck: dead load, axial load, cycles.");
  Fields<StageSpec> f(s.keys);
  f.name("name", &StageSpec::name, "Loads and gauges refer to it.").required();
  f.quantity("duration", &StageSpec::duration, Dimension::time, "Longest duration.").positive().required();
  f.quantity("mass_damping", &StageSpec::mass_damping, Dimension::rate, "c of F = -c m v in this stage.")
      .not_negative()
      .default_is("that of [run]")
      .echoed_if([](StageSpec const& x) { return x.mass_damping >= 0; });
  f.number("local_damping", &StageSpec::local_damping, "alpha of F = -alpha |f| sign(v) in this stage.")
      .range({0, 1, false, true})
      .default_is("that of [run]")
      .echoed_if([](StageSpec const& x) { return x.local_damping >= 0; });
  f.number("settle", &StageSpec::settle,
           "Ends the stage once kinetic over internal energy stays below this; 0 never.")
      .range({0, 1});
  return s;
}

void read_fix(Reader& r, Node const& n, Key const& k, SupportSpec& support) {
  if (!read_array(r, n, k, 0, 3)) return;
  for (auto const& item : n.items) {
    auto const axis = read_axis(r, item, k);
    if (!axis) continue;
    if (support.fix[static_cast<std::size_t>(*axis)]) r.error(item, "`fix` names this axis twice");
    support.fix[static_cast<std::size_t>(*axis)] = true;
  }
}

Written write_fix(SupportSpec const& support) {
  std::vector<std::string> axes;
  for (int i = 0; i < 3; ++i)
    if (support.fix[static_cast<std::size_t>(i)]) axes.push_back(write_axis(i));
  return write_array(axes);
}

Section support_section() {
  Section s = many_section("support", &model::Case::supports,
                           "Holds components of the displacement at zero; also planes of symmetry.");
  Fields<SupportSpec> f(s.keys);
  f.name("name", &SupportSpec::name, "Gauges refer to it.").default_is("`support_1`, `support_2`, ...");
  f.selector("where", &SupportSpec::where, "The nodes held.").required();
  f.custom("fix", "an array of `x`, `y`, `z`", "The components held.", read_fix, write_fix).required();
  return s;
}

template <bool velocity> void read_motion(Reader& r, Node const& n, Key const& k, MotionSpec& motion) {
  motion.is_velocity = velocity;
  read_curve(r, n, k, velocity ? Dimension::velocity : Dimension::length, motion.curve);
}

template <bool velocity> Written write_motion(MotionSpec const& motion) {
  if (motion.is_velocity != velocity || motion.path || motion.record) return std::nullopt;
  return write_curve(motion.curve, velocity ? Dimension::velocity : Dimension::length);
}

void finish_motion(Reader& reader, Node const& table, void* record) {
  int given = 0;
  for (auto const key : {"displacement", "velocity", "acceleration", "path"})
    given += reader.given(record, key) ? 1 : 0;
  if (given != 1)
    reader.error(table, "[[motion]] needs one of `displacement`, `velocity`, `acceleration` and `path`");
  auto const& motion = *static_cast<MotionSpec const*>(record);
  if (motion.path && !motion.path->of.empty() && reader.given(record, "stage"))
    reader.error(reader.place(record, "stage"),
                 "the `stage` is that of the motion whose path this one shares");
  auto const& c = motion.curve;
  bool const jumps = (c.kind == model::Curve::Kind::constant && c.value != 0) ||
                     (c.kind == model::Curve::Kind::ramp && c.over <= 0 && c.value != 0) ||
                     (c.kind == model::Curve::Kind::table && !c.values.empty() && c.values.front() != 0);
  if (!motion.is_velocity && jumps)
    reader.error(table, "a displacement must start at 0: give it a ramp, "
                        "displacement = {value = \"1 mm\", over = \"10 ms\"}");
}

Section motion_section() {
  Section s = many_section(
      "motion", &model::Case::motions,
      "Prescribes one component of the motion of nodes by exactly one of `displacement`, `velocity`, "
      "`acceleration` and `path`.");
  s.finish = finish_motion;
  Fields<MotionSpec> f(s.keys);
  f.name("name", &MotionSpec::name, "Gauges refer to it.").default_is("`motion_1`, `motion_2`, ...");
  f.name("stage", &MotionSpec::stage, stage_doc).default_is(from_start);
  f.selector("where", &MotionSpec::where, "The nodes moved.").required();
  f.axis("axis", &MotionSpec::axis, "The component.").required();
  f.custom("displacement", "a curve of a length", "Displacement; this or `velocity`.", read_motion<false>,
           write_motion<false>)
      .default_is("none");
  f.custom("velocity", "a curve of a velocity", "Velocity. A jump breaks the first joints: use a ramp.",
           read_motion<true>, write_motion<true>)
      .default_is("none");
  f.custom(
       "acceleration", "a record", "By an acceleration record, from rest: ground motion.",
       [](Reader& r, Node const& n, Key const& k, MotionSpec& motion) {
         read_record(r, n, k, motion.record.emplace());
       },
       [](MotionSpec const& motion) -> Written { return write_shape(record_shape(), &*motion.record); })
      .default_is("none")
      .echoed_if([](MotionSpec const& motion) { return motion.record.has_value(); });
  f.custom(
       "path", "a path", "To and fro between readings of gauges.",
       [](Reader& r, Node const& n, Key const& k, MotionSpec& motion) {
         motion.is_velocity = true;
         read_path(r, n, k, motion.path.emplace());
       },
       [](MotionSpec const& motion) -> Written { return write_shape(path_shape(), &*motion.path); })
      .default_is("none")
      .echoed_if([](MotionSpec const& motion) { return motion.path.has_value(); });
  return s;
}

Section force_section() {
  Section s =
      many_section("force", &model::Case::forces, "A total force, shared equally by the nodes picked.");
  Fields<ForceSpec> f(s.keys);
  f.name("name", &ForceSpec::name, "Gauges refer to it.").default_is("`force_1`, `force_2`, ...");
  f.name("stage", &ForceSpec::stage, stage_doc).default_is(from_start);
  f.selector("where", &ForceSpec::where, "The nodes loaded.").required();
  f.direction("direction", &ForceSpec::direction, "Direction of a positive force.").required();
  f.curve("force", &ForceSpec::curve, Dimension::force, "Its size.").required();
  return s;
}

void finish_traction(Reader& reader, Node const& table, void* record) {
  auto const& t = *static_cast<TractionSpec const*>(record);
  if (!reader.good(record, {"normal", "direction"})) return;
  if (t.normal == reader.given(record, "direction"))
    reader.error(table, "[[traction]] needs either `direction` or normal = true");
}

Section traction_section() {
  Section s =
      many_section("traction", &model::Case::tractions, "A force per reference area on boundary faces.");
  s.finish = finish_traction;
  Fields<TractionSpec> f(s.keys);
  f.name("name", &TractionSpec::name, "Gauges refer to it.").default_is("`traction_1`, `traction_2`, ...");
  f.name("stage", &TractionSpec::stage, stage_doc).default_is(from_start);
  f.selector("where", &TractionSpec::where, "The faces, by their centroid.").required();
  f.direction("direction", &TractionSpec::direction, "Direction of a positive traction.")
      .echoed_if([](TractionSpec const& t) { return !t.normal; });
  f.flag("normal", &TractionSpec::normal, "`true`: along the inner normal, a pressure.");
  f.curve("traction", &TractionSpec::curve, Dimension::pressure, "Its size.").required();
  return s;
}

Section absorbing_section() {
  Section s = many_section(
      "absorbing", &model::Case::absorbing,
      "An absorbing boundary (Lysmer): dashpots on boundary faces let waves out of the model. They "
      "hold nothing in place. Components that a support or motion holds are left out.");
  Fields<AbsorbingSpec> f(s.keys);
  f.name("name", &AbsorbingSpec::name, "For the log.").default_is("`absorbing_1`, `absorbing_2`, ...");
  f.selector("where", &AbsorbingSpec::where, "The faces, by their three points.").required();
  return s;
}

Section gravity_section() {
  Section s = single_section("gravity", &model::Case::gravity,
                             "Self-weight of concrete and steel; off without this section.");
  s.make = [](model::Case& c, std::size_t) { c.gravity.on = true; };
  s.count = [](model::Case const& c) { return std::size_t{c.gravity.on ? 1U : 0U}; };
  Fields<GravitySpec> f(s.keys);
  f.name("stage", &GravitySpec::stage, stage_doc).default_is(from_start);
  f.direction("direction", &GravitySpec::direction, "Where it pulls.");
  f.curve("acceleration", &GravitySpec::curve, Dimension::acceleration,
          "Its size; a plain \"9.81 m/s2\" acts at once, a ramp settles sooner.")
      .required();
  return s;
}

} // namespace

std::vector<Section> load_sections() {
  return {stage_section(),    support_section(),   motion_section(), force_section(),
          traction_section(), absorbing_section(), gravity_section()};
}

} // namespace fissura::deck
