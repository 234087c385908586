// [[concrete]], [[joint_region]] and [[steel]].
#include <fmt/core.h>

#include <numbers>

#include "fissura/deck/fields.hpp"
#include "fissura/model/defaults.hpp"
#include "fissura/model/presets.hpp"
#include "fissura/units/decimal.hpp"

namespace fissura::deck {
namespace {

using model::ConcreteSpec;
using model::JointRegionSpec;
using model::SteelSpec;
using Written = std::optional<std::string>;
using model::default_penalty;
using units::Dimension;

bool is_multiple(Node const& n) {
  return n.kind == Node::Kind::number || n.kind == Node::Kind::integer;
}

/// A multiple of E is multiplied by it in finish_concrete, once a preset has had its say.
void read_penalty(Reader& r, Node const& n, Key const& k, ConcreteSpec& c) {
  Wanted wanted(k);
  wanted.dimension = is_multiple(n) ? Dimension::none : Dimension::pressure;
  c.penalty = read_quantity(r, n, wanted).value_or(default_penalty);
}

void read_h(Reader& r, Node const& n, Key const& k, ConcreteSpec& c) {
  bool const is_length = n.kind != Node::Kind::text || !units::leading_number(n.text).empty();
  if (is_length) {
    c.element_size = model::ElementSize::given;
    c.h = read_quantity(r, n, k).value_or(0);
    return;
  }
  auto const word = read_word(r, n, k, {"volume", "joint_edge"});
  if (!word) r.error(n, fmt::format("`{}` may also be a length, e.g. \"30 mm\"", k.name));
  c.element_size = word && *word == 1 ? model::ElementSize::joint_edge : model::ElementSize::volume;
}

Written write_h(ConcreteSpec const& c) {
  if (c.element_size == model::ElementSize::given) return write_quantity(c.h, Dimension::length);
  return write_text(c.element_size == model::ElementSize::volume ? "volume" : "joint_edge");
}

/// What the chosen laws need; a missing strength would otherwise be a joint without strength.
void check_strengths(Reader& reader, Node const& table, ConcreteSpec const& c) {
  bool const cracks = c.joints && c.crackable;
  if (!cracks || !reader.good(&c, {"f_t", "f_c", "G_f", "cohesion", "f_s", "shear", "joints", "crackable"}))
    return;
  if (c.f_t <= 0)
    reader.error(table, "joints that may crack need `f_t`; or set crackable = false or joints = false");
  if (c.G_f <= 0 && c.f_c <= 0)
    reader.error(
        table,
        "joints that may crack need `G_f`, or `f_c` from which it follows (73 f_c^0.18 N/m, f_c in MPa)");
  bool const coulomb = c.shear == model::ShearStrength::mohr_coulomb;
  if (coulomb && c.f_c <= 0 && c.cohesion <= 0)
    reader.error(table,
                 "shear = \"mohr_coulomb\" needs `f_c` or `cohesion`; or set shear = \"constant\" and `f_s`");
  if (!coulomb && c.f_s <= 0) reader.error(table, "shear = \"constant\" needs `f_s`");
  if (coulomb && reader.given(&c, "f_s") && c.f_s > 0)
    reader.error(reader.place(&c, "f_s"),
                 "`f_s` is used by shear = \"constant\" only; this material has \"mohr_coulomb\"");
  if (c.f_c > 0 && c.f_t > c.f_c)
    reader.error(reader.place(&c, "f_t"), fmt::format("`f_t` = {} is larger than `f_c` = {}",
                                                      units::from_si(c.f_t, Dimension::pressure),
                                                      units::from_si(c.f_c, Dimension::pressure)));
}

/// Fills in what the deck leaves to the preset.
void apply_preset(Reader& reader, Node const& table, ConcreteSpec& c) {
  if (!reader.good(&c, {"preset", "f_c", "f_ck"})) return;
  auto const range = model::preset_range(c.preset);
  auto const name = model::preset_name(c.preset);
  if (c.f_c <= 0)
    return reader.error(table,
                        fmt::format("preset = \"{}\" needs `f_c`, the mean strength, or `f_ck`, that of the "
                                    "class",
                                    name));
  double const f_ck = c.f_c - model::strength_margin;
  auto const pressure = [](double x) { return units::from_si(x, Dimension::pressure); };
  if (f_ck < range.least * (1 - 1e-9) || f_ck > range.most * (1 + 1e-9))
    return reader.error(
        reader.place(&c, reader.given(&c, "f_ck") ? "f_ck" : "f_c"),
        fmt::format("preset = \"{}\" covers f_ck = {} to {}, that is f_c = f_ck + 8 MPa = {} to {}; "
                    "give `E`, `f_t` and `G_f` without a preset",
                    name, pressure(range.least), pressure(range.most),
                    pressure(range.least + model::strength_margin),
                    pressure(range.most + model::strength_margin)));
  auto const values = model::preset_values(c.preset, c.f_c);
  if (!reader.given(&c, "E")) c.E = values.E.value;
  if (!reader.given(&c, "f_t")) c.f_t = values.f_t.value;
  if (!reader.given(&c, "G_f")) c.G_f = values.G_f.value;
}

void finish_concrete(Reader& reader, Node const& table, void* record) {
  auto& c = *static_cast<ConcreteSpec*>(record);
  if (c.preset != model::ConcretePreset::none)
    apply_preset(reader, table, c);
  else if (!reader.given(record, "E"))
    reader.error(table,
                 "[[concrete]] needs `E`: a pressure; or preset = \"mc2010\", which takes it from `f_c`");
  Node const* penalty = table.find("penalty");
  if (!penalty)
    c.penalty = default_penalty * c.E;
  else if (is_multiple(*penalty))
    c.penalty *= c.E;
  if (reader.given(record, "f_ck") && reader.given(record, "f_c"))
    reader.error(reader.place(record, "f_ck"),
                 "give either `f_c`, the mean strength, or `f_ck`, that of the class: f_c = f_ck + 8 MPa");
  check_strengths(reader, table, c);
}

/// The echo says which values a preset stands behind.
std::string remark(ConcreteSpec const& c, double value, model::PresetValue model::PresetValues::*which) {
  if (c.preset == model::ConcretePreset::none) return {};
  auto const preset = model::preset_values(c.preset, c.f_c).*which;
  return value == preset.value ? fmt::format("  # {}: {}", model::preset_name(c.preset), preset.formula) : "";
}

/// Adds the remark to the key just added.
void remarked(std::vector<Key>& keys, double ConcreteSpec::*field,
              model::PresetValue model::PresetValues::*which) {
  keys.back().write = [field, which, write = keys.back().write](void const* record) -> Written {
    auto const& c = *static_cast<ConcreteSpec const*>(record);
    auto text = write(record);
    if (text) *text += remark(c, c.*field, which);
    return text;
  };
}

void add_preset(Fields<ConcreteSpec>& f) {
  f.word("preset", &ConcreteSpec::preset,
         {{"none", model::ConcretePreset::none},
          {"mc2010", model::ConcretePreset::mc2010},
          {"ec2", model::ConcretePreset::ec2}},
         "The code that gives E, f_t and G_f from f_c where they are left out: fib Model Code 2010, or "
         "Eurocode 2 (G_f is that of MC2010). `fissura check` prints values and formulas; see materials.md.");
  f.custom(
       "f_ck", "a pressure", "Characteristic strength, as in the name of the class: f_c = f_ck + 8 MPa.",
       [](Reader& r, Node const& n, Key const& k, ConcreteSpec& c) {
         c.f_c = read_quantity(r, n, k).value_or(0) + model::strength_margin;
       },
       [](ConcreteSpec const&) -> Written { return std::nullopt; })
      .of(Dimension::pressure)
      .positive()
      .default_is("f_c - 8 MPa");
}

void add_elasticity(Fields<ConcreteSpec>& f, std::vector<Key>& keys) {
  f.name("name", &ConcreteSpec::name, "Names the material in the log.")
      .default_is("`concrete_1`, `concrete_2`, ...");
  f.texts("groups", &ConcreteSpec::groups, "Volume groups made of it.")
      .default_is("all groups that no other material names");
  f.quantity("E", &ConcreteSpec::E, Dimension::pressure, "Young's modulus.")
      .positive()
      .default_is("required without `preset`");
  remarked(keys, &ConcreteSpec::E, &model::PresetValues::E);
  f.number("nu", &ConcreteSpec::nu, "Poisson's ratio.").range({-1, 0.5, true, true});
  f.quantity("density", &ConcreteSpec::density, Dimension::density, "Mass density.").positive();
  f.number(
       "density_factor", &ConcreteSpec::density_factor,
       "Mass scaling: multiplies the inertia (not the weight) for longer steps; the added mass is reported.")
      .positive();
  f.word("elastic", &ConcreteSpec::elastic,
         {{"as_given", model::Elasticity::as_given}, {"compensated", model::Elasticity::compensated}},
         "Elastic constants of the tets: `E` and `nu`, so that the body is softer by its joints, or stiffer "
         "by what "
         "their joints add, so that the body has them.");
  f.word("tet_law", &ConcreteSpec::tet_law,
         {{"hyperelastic", model::TetLaw::hyperelastic}, {"paper", model::TetLaw::paper}},
         "Law of the tetrahedra; equal at small strain.");
  f.quantity("mu_bar", &ConcreteSpec::mu_bar, Dimension::viscosity,
             "Viscous damping of the tetrahedra (Eq. 8).")
      .not_negative();
}

void add_strength(Fields<ConcreteSpec>& f, std::vector<Key>& keys) {
  f.quantity("f_t", &ConcreteSpec::f_t, Dimension::pressure,
             "Tensile strength; required where joints may crack.")
      .not_negative();
  remarked(keys, &ConcreteSpec::f_t, &model::PresetValues::f_t);
  f.quantity("f_c", &ConcreteSpec::f_c, Dimension::pressure,
             "Compressive strength, mean: cohesion, bond and dowel follow from it.")
      .not_negative();
  f.quantity("G_f", &ConcreteSpec::G_f, Dimension::energy_per_area,
             "Fracture energy, mode I; 0: 73 f_c^0.18 N/m with f_c in MPa (fib Model Code 2010).")
      .not_negative();
  remarked(keys, &ConcreteSpec::G_f, &model::PresetValues::G_f);
  f.quantity("G_s", &ConcreteSpec::G_s, Dimension::energy_per_area,
             "Fracture energy, mode II; 0: the same as G_f.")
      .not_negative();
  f.word("shear", &ConcreteSpec::shear,
         {{"mohr_coulomb", model::ShearStrength::mohr_coulomb}, {"constant", model::ShearStrength::constant}},
         "Shear strength: cohesion and friction angle, or the constant f_s.");
  f.quantity("friction_angle", &ConcreteSpec::friction_angle, Dimension::angle,
             "Internal friction of uncracked joints.")
      .range({0, std::numbers::pi / 2, false, true});
  f.quantity("cohesion", &ConcreteSpec::cohesion, Dimension::pressure,
             "Cohesion; 0: f_c (1 - sin phi)/(2 cos phi).")
      .not_negative();
  f.quantity("f_s", &ConcreteSpec::f_s, Dimension::pressure, "Shear strength for shear = \"constant\".")
      .not_negative();
  f.number("friction", &ConcreteSpec::friction, "Friction coefficient of crack faces.").range({0, 10});
}

void add_joints(Fields<ConcreteSpec>& f) {
  f.flag("joints", &ConcreteSpec::joints,
         "`false`: its tetrahedra are bonded to each other, without joints between them.");
  f.flag("crackable", &ConcreteSpec::crackable, "`false`: its joints stay linear elastic.");
  f.custom(
       "penalty", "a number (times E) or a pressure",
       "Stiffness p of the joints: a larger one adds less compliance and, without `joint_inertia` of [run], "
       "asks for shorter steps.",
       read_penalty,
       [](ConcreteSpec const& c) -> Written { return write_quantity(c.penalty, Dimension::pressure); })
      .positive()
      .default_is("20");
  f.custom("h", "`volume`, `joint_edge` or a length",
           "Element size of the peak opening o_p = 2 h f_t/p: of the neighbours' volume, or the mean edge of "
           "the joint.",
           read_h, write_h)
      .of(Dimension::length)
      .positive();
  f.word("joint_law", &ConcreteSpec::joint_law,
         {{"energy_consistent", model::JointLaw::energy_consistent}, {"paper", model::JointLaw::paper}},
         "Cohesive law; equal in pure modes.");
  f.word("softening_range", &ConcreteSpec::softening_range,
         {{"exact", model::SofteningRange::exact}, {"y3d", model::SofteningRange::y3d}},
         "`exact` dissipates G_f; `y3d` is 3 G_f/f_t and dissipates 16 % more.");
  f.word("rate_factor", &ConcreteSpec::rate_factor,
         {{"none", model::RateFactor::none}, {"mc2010", model::RateFactor::mc2010}},
         "Growth of f_t and of f_s (the cohesion with Mohr-Coulomb) with the strain rate: none, or that of "
         "fib Model "
         "Code 2010. With it the joints are straight up to their strength.");
}

Section concrete_section() {
  Section s = many_section(
      "concrete", &model::Case::concretes,
      "A material of the tetrahedra and of the joints between them: concrete, or elastic plates.");
  s.finish = finish_concrete;
  Fields<ConcreteSpec> f(s.keys);
  add_preset(f);
  add_elasticity(f, s.keys);
  add_strength(f, s.keys);
  add_joints(f);
  return s;
}

Section joint_region_section() {
  Section s = many_section("joint_region", &model::Case::joint_regions,
                           "Changes the joints in a region: notches, grips, layers near loads and supports.");
  Fields<JointRegionSpec> f(s.keys);
  f.selector("where", &JointRegionSpec::where, "The joints, by their centroid.").required();
  f.number("strength_factor", &JointRegionSpec::strength_factor,
           "Multiplies f_t and f_s or the cohesion, not G_f.")
      .range({0, 1e6, true, false});
  f.flag("crackable", &JointRegionSpec::crackable, "`false`: these joints stay linear elastic.");
  f.custom(
       "axis", "`x`, `y` or `z`", "Only joints whose normal lies within 10 degrees of this axis: a notch.",
       [](Reader& r, Node const& n, Key const& k, JointRegionSpec& region) {
         region.axis = read_axis(r, n, k).value_or(0);
         region.only_axis = true;
       },
       [](JointRegionSpec const& region) -> Written { return write_axis(region.axis); })
      .default_is("all joints there")
      .echoed_if([](JointRegionSpec const& region) { return region.only_axis; });
  return s;
}

void finish_steel(Reader& reader, Node const&, void* record) {
  auto const& s = *static_cast<SteelSpec const*>(record);
  auto const pressure = [](double x) { return units::from_si(x, Dimension::pressure); };
  bool const strengths = reader.good(record, {"f_y", "f_u"});
  if (strengths && s.f_u < s.f_y)
    reader.error(reader.place(record, "f_u"), fmt::format("`f_u` = {} must not be less than `f_y` = {}",
                                                          pressure(s.f_u), pressure(s.f_y)));
  if (reader.good(record, {"E_s", "f_y", "eps_sh"}) && s.eps_sh <= s.f_y / s.E_s)
    reader.error(reader.place(record, "eps_sh"),
                 fmt::format("`eps_sh` = {} must be larger than the strain at yield, f_y/E_s = {:.3g}",
                             s.eps_sh, s.f_y / s.E_s));
  if (reader.good(record, {"eps_sh", "eps_u"}) && s.eps_u <= s.eps_sh)
    reader.error(reader.place(record, "eps_u"),
                 fmt::format("`eps_u` = {} must be larger than `eps_sh` = {}", s.eps_u, s.eps_sh));
  if (reader.good(record, {"eps_u", "eps_br"}) && s.eps_br <= s.eps_u)
    reader.error(reader.place(record, "eps_br"),
                 fmt::format("`eps_br` = {} must be larger than `eps_u` = {}", s.eps_br, s.eps_u));
}

Section steel_section() {
  Section s =
      many_section("steel", &model::Case::steels,
                   "A reinforcing steel. The order of the strains is f_y/E_s < eps_sh < eps_u < eps_br.");
  s.finish = finish_steel;
  Fields<SteelSpec> f(s.keys);
  f.name("name", &SteelSpec::name, "Bars refer to it.").required();
  f.quantity("E_s", &SteelSpec::E_s, Dimension::pressure, "Young's modulus.").positive();
  f.quantity("f_y", &SteelSpec::f_y, Dimension::pressure, "Yield strength.").positive().required();
  f.quantity("f_u", &SteelSpec::f_u, Dimension::pressure, "Tensile strength.").positive().required();
  f.number("eps_sh", &SteelSpec::eps_sh, "Strain where hardening begins.").range({0, 1, true, false});
  f.number("eps_u", &SteelSpec::eps_u, "Strain at f_u.").range({0, 1, true, false});
  f.number("eps_br", &SteelSpec::eps_br, "Strain at rupture.").range({0, 1, true, false});
  f.quantity("density", &SteelSpec::density, Dimension::density, "Mass density.").positive();
  f.word("law", &SteelSpec::law,
         {{"kato", model::SteelLaw::kato}, {"menegotto_pinto", model::SteelLaw::menegotto_pinto}},
         "Cyclic law; `menegotto_pinto` for large reversals.");
  return s;
}

} // namespace

std::vector<Section> material_sections() {
  return {concrete_section(), joint_region_section(), steel_section()};
}

} // namespace fissura::deck
