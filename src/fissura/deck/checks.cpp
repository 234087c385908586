#include "fissura/deck/checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "fissura/deck/nearest.hpp"
#include "fissura/deck/values.hpp"

namespace fissura::deck {
namespace {

using Names = std::vector<std::string_view>;

template <class Specs> void add_names(Names& names, Specs const& specs) {
  for (auto const& spec : specs)
    if (!spec.name.empty()) names.push_back(spec.name);
}
template <class... Specs> Names names_of(Specs const&... specs) {
  Names names;
  (add_names(names, specs), ...);
  return names;
}

/// Those of the deck and those of its cages.
std::vector<model::BarSpec const*> all_bars(model::Case const& c) {
  std::vector<model::BarSpec const*> bars;
  for (auto const& bar : c.bars) bars.push_back(&bar);
  for (auto const& cage : c.cages)
    for (auto const& bar : cage.made) bars.push_back(&bar);
  return bars;
}

Names names_of_bars(model::Case const& c) {
  Names names;
  for (auto const* bar : all_bars(c)) names.push_back(bar->name);
  return names;
}

template <class Spec> void name_them(std::vector<Spec>& specs, std::string_view section) {
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (specs[i].name.empty()) specs[i].name = fmt::format("{}_{}", section, i + 1);
}

/// A reference by name; `what` names the kind of thing referred to, with its section.
void check_reference(Reader& reader, void const* record, std::string_view key, std::string const& name,
                     Names const& known, std::string_view what) {
  if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
  std::string hint = did_you_mean(name, known);
  if (known.empty())
    hint = fmt::format("; this deck has no {}", what);
  else if (hint.empty())
    hint = fmt::format("; there are {}", listed(known));
  reader.error(reader.place(record, key),
               fmt::format("`{}`: no {} is named \"{}\"{}", key, what, name, hint));
}

using Seen = std::map<std::string_view, core::Place>;

template <class Specs> void check_duplicates(Reader& reader, Specs const& specs, Seen& seen) {
  for (auto const& spec : specs) {
    if (spec.name.empty()) continue;
    auto const [first, fresh] = seen.emplace(spec.name, spec.place);
    if (!fresh)
      reader.error(reader.place(&spec, "name"),
                   fmt::format("the name \"{}\" is taken: it stands already at {}", spec.name,
                               core::to_string(first->second)));
  }
}
/// Sections whose items are referred to by the same key share their names.
template <class... Specs> void check_unique(Reader& reader, Specs const&... specs) {
  Seen seen;
  (check_duplicates(reader, specs, seen), ...);
}

/// A bar of the deck may have the name of a cage's bar.
void check_names_of_cage_bars(Reader& reader) {
  for (auto const& bar : reader.the_case.bars)
    for (auto const& cage : reader.the_case.cages)
      for (auto const& made : cage.made)
        if (made.name == bar.name)
          reader.error(reader.place(&bar, "name"),
                       fmt::format("the name \"{}\" is taken by the [[cage]] \"{}\"", bar.name, cage.name));
}

void check_names(Reader& reader) {
  auto const& c = reader.the_case;
  check_unique(reader, c.concretes);
  check_unique(reader, c.steels);
  check_unique(reader, c.bars);
  check_unique(reader, c.cages);
  check_names_of_cage_bars(reader);
  check_unique(reader, c.stages);
  check_unique(reader, c.supports, c.motions);
  check_unique(reader, c.forces, c.tractions);
  check_unique(reader, c.planes, c.impactors);
  check_unique(reader, c.absorbing);
  check_unique(reader, c.gauges);
}

template <class Specs> void check_stages(Reader& reader, Specs const& specs, Names const& stages) {
  for (auto const& spec : specs) check_reference(reader, &spec, "stage", spec.stage, stages, "[[stage]]");
}

void check_loads(Reader& reader) {
  auto const& c = reader.the_case;
  Names const stages = names_of(c.stages);
  check_stages(reader, c.motions, stages);
  check_stages(reader, c.forces, stages);
  check_stages(reader, c.tractions, stages);
  if (c.gravity.on) check_reference(reader, &c.gravity, "stage", c.gravity.stage, stages, "[[stage]]");
}

/// The element of an uncracked bar is elastic, and a bar joint starts from a stress below f_y: a bar that has
/// yielded before the run begins has no place in either, and its energy would be in no account.
void check_prestress(Reader& reader, model::BarSpec const& bar) {
  for (auto const& steel : reader.the_case.steels) {
    if (steel.name != bar.steel || !reader.good(&steel, {"f_y", "E_s"})) continue;
    double const yield = steel.f_y / steel.E_s;
    if (std::abs(bar.initial_strain) < yield) return;
    reader.error(
        reader.place(&bar, "initial_strain"),
        fmt::format("`initial_strain` = {} must be smaller than the strain at yield of steel \"{}\", f_y/E_s "
                    "= {:.3g}: the bar would have yielded before the run begins. Give a smaller strain, or "
                    "the bar a stronger steel",
                    bar.initial_strain, bar.steel, yield));
    return;
  }
}

void check_bars(Reader& reader) {
  auto const& c = reader.the_case;
  Names const steels = names_of(c.steels);
  for (auto const& bar : c.bars) {
    check_reference(reader, &bar, "steel", bar.steel, steels, "[[steel]]");
    if (reader.good(&bar, {"initial_strain"})) check_prestress(reader, bar);
    if (!bar.curve.empty() && !c.mesh.boxes.empty())
      reader.error(reader.place(&bar, "curve"),
                   "`curve` names a curve of a mesh file, and this mesh is made of boxes: give `points`");
  }
  for (auto const& cage : c.cages) {
    check_reference(reader, &cage, "steel", cage.steel, steels, "[[steel]]");
    check_reference(reader, &cage, "stirrup_steel", cage.stirrup_steel, steels, "[[steel]]");
  }
  bool const twice = c.bar_settings.between_cracks == model::BarBetweenCracks::elastic;
  auto const is_consistent = [](model::BarSpec const* bar) {
    return bar->slip_reduction == model::SlipReduction::consistent;
  };
  if (auto const bars = all_bars(c); twice && std::any_of(bars.begin(), bars.end(), is_consistent))
    reader.error(reader.place(&c.bar_settings, "between_cracks"),
                 "`between_cracks` = \"elastic\" counts the bar between cracks twice where slip_reduction = "
                 "\"consistent\": leave it out, or give all bars slip_reduction = \"paper\"");
  auto const has_f_c = [&](auto const& m) { return m.f_c > 0 || !reader.good(&m, {"f_c"}); };
  if ((!c.bars.empty() || !c.cages.empty()) && !c.concretes.empty() &&
      std::none_of(c.concretes.begin(), c.concretes.end(), has_f_c))
    reader.error(c.concretes.front().place,
                 "a material with bars needs `f_c`: bond and dowel follow from it");
}

void check_bar_gauge(Reader& reader, model::GaugeSpec const& gauge) {
  auto const& c = reader.the_case;
  check_reference(reader, &gauge, "bar", gauge.bar, names_of_bars(c), "[[bar]]");
  for (auto const* pointer : all_bars(c))
    if (auto const& bar = *pointer;
        bar.name == gauge.bar && bar.curve.empty() && gauge.copy >= bar.count && reader.good(&bar, {"count"}))
      reader.error(reader.place(&gauge, "copy"),
                   fmt::format("`copy` = {}: the bar \"{}\" has {} copies, numbered from 0", gauge.copy,
                               bar.name, bar.count));
}

void check_gauges(Reader& reader) {
  using Kind = model::GaugeSpec::Kind;
  auto const& c = reader.the_case;
  Names const held = names_of(c.supports, c.motions), loads = names_of(c.forces, c.tractions),
              stages = names_of(c.stages), bodies = names_of(c.planes, c.impactors),
              impactors = names_of(c.impactors);
  for (auto const& gauge : c.gauges) {
    check_reference(reader, &gauge, "zero_at", gauge.zero_at, stages, "[[stage]]");
    if (gauge.kind == Kind::bar) check_bar_gauge(reader, gauge);
    for (auto const& name : gauge.of) {
      if (gauge.kind == Kind::reaction)
        check_reference(reader, &gauge, "of", name, held, "[[support]] or [[motion]]");
      if (gauge.kind == Kind::force)
        check_reference(reader, &gauge, "of", name, loads, "[[force]] or [[traction]]");
      if (gauge.kind == Kind::contact_force || gauge.kind == Kind::contact_impulse)
        check_reference(reader, &gauge, "of", name, bodies, "[[plane]] or [[impactor]]");
      if (gauge.kind == Kind::impactor_displacement || gauge.kind == Kind::impactor_velocity)
        check_reference(reader, &gauge, "of", name, impactors, "[[impactor]]");
    }
  }
  for (auto const& stop : c.stops)
    check_reference(reader, &stop, "gauge", stop.gauge, names_of(c.gauges), "[[gauge]]");
}

/// Gauges are known only now: the value of a target takes the unit of its gauge.
void check_target(Reader& reader, model::PathSpec::Target& target) {
  auto const& gauges = reader.the_case.gauges;
  auto const gauge =
      std::find_if(gauges.begin(), gauges.end(), [&](auto const& g) { return g.name == target.gauge; });
  if (gauge == gauges.end()) {
    Names const known = names_of(gauges);
    std::string const hint =
        known.empty() ? std::string("; this deck has no [[gauge]]") : did_you_mean(target.gauge, known);
    return reader.error(target.place,
                        fmt::format("`gauge`: no [[gauge]] is named \"{}\"{}", target.gauge, hint));
  }
  if (target.written.empty()) return;
  Node written;
  written.kind = Node::Kind::text, written.text = target.written, written.place = target.place;
  target.value = read_quantity(reader, written, Wanted("value", dimension_of(*gauge))).value_or(0);
}

void check_paths(Reader& reader) {
  auto& motions = reader.the_case.motions;
  Names owners;
  for (auto const& motion : motions)
    if (motion.path && motion.path->of.empty()) owners.push_back(motion.name);
  for (auto& motion : motions) {
    if (!motion.path) continue;
    for (auto& target : motion.path->targets) check_target(reader, target);
    check_reference(reader, &motion, "path", motion.path->of, owners, "[[motion]] with a path of its own");
  }
}

/// Every group has one material, and at most one material takes what is left.
void check_materials(Reader& reader) {
  auto const& c = reader.the_case;
  if (c.concretes.empty())
    reader.error(core::Place{c.deck_file}, "the deck needs at least one material: [[concrete]]");
  std::map<std::string_view, model::ConcreteSpec const*> owner;
  model::ConcreteSpec const* rest = nullptr;
  for (auto const& m : c.concretes) {
    for (auto const& group : m.groups)
      if (auto const [first, fresh] = owner.emplace(group, &m); !fresh)
        reader.error(reader.place(&m, "groups"),
                     fmt::format("the group \"{}\" has two materials: \"{}\" and \"{}\"", group,
                                 first->second->name, m.name));
    if (!m.groups.empty() || !reader.good(&m, {"groups"})) continue;
    if (rest)
      reader.error(
          m.place,
          fmt::format(
              "the materials \"{}\" and \"{}\" have no `groups`; only one may take all groups that are left",
              rest->name, m.name));
    rest = &m;
  }
  Names const names = names_of(c.concretes);
  for (auto const& p : c.contact_pairs)
    for (auto const& name : p.materials)
      check_reference(reader, &p, "materials", name, names, "[[concrete]]");
}

void check_mesh(Reader& reader) {
  auto const& c = reader.the_case;
  if (!reader.given(&c.mesh, "file") && c.mesh.boxes.empty() && c.mesh.place.line == 0)
    reader.error(core::Place{c.deck_file}, "the deck needs a mesh: [mesh] with `file`, or [[mesh.box]]");
  constexpr double most_cells = 5e7;
  double cells = 0;
  for (auto const& box : c.mesh.boxes) cells += 1.0 * box.cells[0] * box.cells[1] * box.cells[2];
  if (c.mesh.boxes.size() > 1 && cells > most_cells)
    reader.error(c.mesh.place, fmt::format("the boxes make {:.3g} cells together; at most {:.0e} are allowed",
                                           cells, most_cells));
}

void check_duration(Reader& reader) {
  auto const& c = reader.the_case;
  if (c.run.end_time > 0 || !c.stages.empty() || !reader.good(&c.run, {"end_time"})) return;
  auto place = reader.place(&c.run, "end_time");
  if (place.file.empty()) place.file = c.deck_file;
  reader.error(place, "the run needs an end: `end_time` in [run], or [[stage]] tables");
}

/// As many rows and frames as their numbers may say.
void check_output(Reader& reader) {
  auto const& c = reader.the_case;
  double end = c.run.end_time;
  if (!(end > 0))
    for (auto const& stage : c.stages) end += stage.duration;
  auto const limit = [&](std::string_view key, double every, double most, std::string_view what) {
    if (every > 0 && end / every > most)
      reader.error(
          reader.place(&c.output, key),
          fmt::format("`{}` = {} makes {:.3g} {} to {}; at most {:.0e} are allowed: is the unit right?", key,
                      units::from_si(every, units::Dimension::time), end / every, what,
                      units::from_si(end, units::Dimension::time), most));
  };
  limit("frames_every", c.output.frames_every, 1e5, "frames");
  limit("history_every", c.output.history_every, 1e7, "rows");
}

void check_pace(Reader& reader) {
  auto const& c = reader.the_case;
  if (!(c.run.pace > 1)) return;
  auto const refuse = [&](std::string_view what) {
    reader.error(
        reader.place(&c.run, "pace"),
        fmt::format(
            "`pace` is for loading in which inertia does not matter; the deck has {}, which happen in "
            "their own time: remove one of the two",
            what));
  };
  if (!c.impactors.empty()) refuse("impactors");
  if (!c.initial_velocities.empty()) refuse("initial velocities");
  if (!c.absorbing.empty()) refuse("absorbing boundaries");
  for (auto const& m : c.motions)
    if (m.record) return refuse("acceleration records");
}

} // namespace

void name_the_unnamed(model::Case& c) {
  name_them(c.concretes, "concrete");
  name_them(c.bars, "bar");
  name_them(c.cages, "cage");
  name_them(c.supports, "support");
  name_them(c.motions, "motion");
  name_them(c.forces, "force");
  name_them(c.tractions, "traction");
  name_them(c.planes, "plane");
  name_them(c.impactors, "impactor");
  name_them(c.absorbing, "absorbing");
}

void check_case(Reader& reader) {
  check_mesh(reader);
  check_materials(reader);
  check_names(reader);
  check_bars(reader);
  check_loads(reader);
  check_gauges(reader);
  check_paths(reader);
  check_duration(reader);
  check_pace(reader);
  check_output(reader);
}

} // namespace fissura::deck
