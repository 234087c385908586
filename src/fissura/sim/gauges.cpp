#include "fissura/sim/gauges.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "fissura/concrete/concrete.hpp"
#include "fissura/deck/deck.hpp"
#include "fissura/loads/curve.hpp"
#include "fissura/loads/loads.hpp"
#include "fissura/model/select.hpp"
#include "fissura/rebar/rebar.hpp"

namespace fissura::sim {

using model::GaugeSpec;
using model::Model;
using state::State;

namespace {

/// All copies of the mesh points.
std::vector<int> copies_of(Model const& m, std::vector<int> const& points) {
  std::vector<char> wanted(m.mesh.points.size(), 0);
  for (int const p : points) wanted[p] = 1;
  std::vector<int> nodes;
  for (std::size_t t = 0; t < m.mesh.tets.size(); ++t)
    for (int a = 0; a < 4; ++a)
      if (wanted[m.mesh.tets[t][a]]) nodes.push_back(model::node_of(static_cast<int>(t), a));
  return nodes;
}

std::vector<int> nearest_node(Model const& m, Vec3 at) {
  model::Selector s;
  s.kind = model::Selector::Kind::point;
  s.from = at;
  return copies_of(m, model::select_points(m.mesh, s));
}

Vec3 mean_displacement(State const& s, std::vector<int> const& nodes) {
  Vec3 sum;
  for (int const n : nodes) sum += s.u.at(n);
  return sum / static_cast<double>(std::max<std::size_t>(1, nodes.size()));
}

Vec3 mean_position(Model const& m, std::vector<int> const& nodes) {
  Vec3 sum;
  for (int const n : nodes) sum += m.position.at(n);
  return sum / static_cast<double>(std::max<std::size_t>(1, nodes.size()));
}

double mean_component(core::NodeField const& field, std::vector<int> const& nodes, int axis) {
  double sum = 0;
  for (int const n : nodes) sum += field(n, axis);
  return sum / static_cast<double>(std::max<std::size_t>(1, nodes.size()));
}

/// Barycentric weights of the point where the segment meets the triangle, or false.
bool crosses(Vec3 from, Vec3 to, std::array<Vec3, 3> const& x, std::array<double, 3>& weight) {
  Vec3 const e1 = x[1] - x[0], e2 = x[2] - x[0], d = to - from, p = cross(d, e2);
  double const det = dot(e1, p);
  if (std::abs(det) < 1e-12 * norm(e1) * norm(e2) * norm(d)) return false;
  Vec3 const t = from - x[0], q = cross(t, e1);
  double const a = dot(t, p) / det, b = dot(d, q) / det, along = dot(e2, q) / det;
  if (a < 0 || b < 0 || a + b > 1 || along < 0 || along > 1) return false;
  weight = {1 - a - b, a, b};
  return true;
}

/// Two unit vectors across a direction.
std::pair<Vec3, Vec3> across(Vec3 along) {
  Vec3 const help = std::abs(along.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 const a = unit(cross(along, help));
  return {a, cross(along, a)};
}

/// Joints met by the gauge's line moved by `shift`.
std::vector<Gauge::Crossing> crossings_of(Model const& m, Gauge const& g, Vec3 shift) {
  std::vector<Gauge::Crossing> found;
  for (int i = 0; i < m.joints.count; ++i) {
    auto const& joint = m.joints.joints[i];
    std::array<Vec3, 3> x;
    for (int k = 0; k < 3; ++k) x[k] = mean_position(m, {joint.node_a[k]});
    Gauge::Crossing c{i, {}};
    if (crosses(g.spec.from + shift, g.spec.to + shift, x, c.weight)) found.push_back(c);
  }
  return found;
}

/// The line is moved by a hair so that it does not run through mesh points; to the side where there is
/// concrete, since gauges often lie on the surface.
void resolve_crossings(Model const& m, Gauge& g) {
  auto const [a, b] = across(g.along);
  double const hair = 1e-4 * g.length;
  for (auto const& [p, q] : {std::pair{1.0, 1.0}, {1.0, -1.0}, {-1.0, 1.0}, {-1.0, -1.0}}) {
    g.crossings = crossings_of(m, g, p * hair * a + q * 0.618 * hair * b);
    if (!g.crossings.empty()) return;
  }
  throw core::InputError(g.spec.place,
                         fmt::format("the line of gauge `{}` crosses no joint of the mesh", g.spec.name));
}

void resolve_bar(Model const& m, Gauge& g) {
  int bar = -1;
  for (std::size_t i = 0; i < m.bars.properties.size(); ++i)
    if (m.bars.properties[i].name == g.spec.bar) bar = static_cast<int>(i);
  double best = std::numeric_limits<double>::max(), best_joint = best;
  auto point = [&](int tet, std::array<double, 4> const& w) {
    auto const x = mesh::corners(m.mesh, tet);
    return w[0] * x[0] + w[1] * x[1] + w[2] * x[2] + w[3] * x[3];
  };
  for (std::size_t i = 0; i < m.bars.elements.size(); ++i) {
    auto const& e = m.bars.elements[i];
    if (e.bar != bar || e.copy != g.spec.copy) continue;
    double const d = norm(point(e.tet, e.w0) + 0.5 * e.axis - g.spec.from);
    if (d < best) best = d, g.bar_element = static_cast<int>(i);
  }
  for (std::size_t i = 0; i < m.bars.joints.size(); ++i) {
    auto const& j = m.bars.joints[i];
    if (j.bar != bar || j.copy != g.spec.copy) continue;
    double const d = norm(point(j.tet_a, j.w_a) - g.spec.from);
    if (d < best_joint) best_joint = d, g.bar_joint = static_cast<int>(i);
  }
  bool const wants_element = g.spec.quantity == "stress";
  if (wants_element ? g.bar_element < 0 : g.bar_joint < 0)
    throw core::InputError(
        g.spec.place, fmt::format("gauge `{}`: copy {} of bar `{}` has no bar {} in the mesh", g.spec.name,
                                  g.spec.copy, g.spec.bar, wants_element ? "element" : "joint"));
}

void resolve_names(Model const& m, Gauge& g) {
  for (auto const& name : g.spec.of) {
    bool found = false;
    for (std::size_t i = 0; i < m.prescribed.size(); ++i) {
      if (m.prescribed[i].name != name) continue;
      found = true;
      if (m.prescribed[i].axis == g.spec.axis) g.prescribed.push_back(static_cast<int>(i));
    }
    for (std::size_t i = 0; i < m.forces.size(); ++i)
      if (m.forces[i].name == name) found = true, g.forces.push_back(static_cast<int>(i));
    if (!found)
      throw core::InputError(
          g.spec.place,
          fmt::format("gauge `{}`: there is no support, motion or force `{}`", g.spec.name, name));
  }
  if (g.spec.kind == GaugeSpec::Kind::reaction && g.prescribed.empty())
    throw core::InputError(g.spec.place,
                           fmt::format("gauge `{}`: none of the named supports holds the {} direction",
                                       g.spec.name, "xyz"[g.spec.axis]));
}

void resolve_bodies(Model const& m, Gauge& g) {
  for (auto const& name : g.spec.of) {
    auto const known = g.bodies.size();
    for (std::size_t i = 0; i < m.rigid.size(); ++i)
      if (m.rigid[i].name == name) g.bodies.push_back(static_cast<int>(i));
    if (g.bodies.size() == known)
      throw core::InputError(
          g.spec.place, fmt::format("gauge `{}`: there is no plane or impactor `{}`", g.spec.name, name));
  }
}

void resolve_impactor(Model const& m, Gauge& g) {
  resolve_bodies(m, g);
  if (g.bodies.size() != 1 || !m.rigid[static_cast<std::size_t>(g.bodies[0])].is_impactor)
    throw core::InputError(g.spec.place, fmt::format("gauge `{}`: `of` must name one impactor", g.spec.name));
}

void resolve_line(Gauge& g) {
  g.length = norm(g.spec.to - g.spec.from);
  g.along = unit(g.spec.to - g.spec.from);
  if (!(g.length > 0))
    throw core::InputError(g.spec.place,
                           fmt::format("gauge `{}`: the two ends of `line` are the same point", g.spec.name));
}

Gauge resolve(Model const& m, GaugeSpec const& spec) {
  Gauge g;
  g.spec = spec;
  switch (spec.kind) {
  case GaugeSpec::Kind::displacement:
  case GaugeSpec::Kind::velocity:
    g.nodes = copies_of(m, model::select_points(m.mesh, spec.where));
    g.unit = spec.kind == GaugeSpec::Kind::velocity ? "m/s" : "m";
    break;
  case GaugeSpec::Kind::reaction:
  case GaugeSpec::Kind::force:
    resolve_names(m, g);
    g.unit = "N";
    g.reads_forces = true;
    break;
  case GaugeSpec::Kind::bar:
    resolve_bar(m, g);
    g.unit = spec.quantity == "stress" || spec.quantity == "joint_stress" ? "Pa"
             : spec.quantity == "slip"                                    ? "m"
             : spec.quantity == "dowel_force"                             ? "N"
                                                                          : "-";
    g.reads_forces = true; // bar stresses are those the step has just used
    break;
  case GaugeSpec::Kind::contact_force:
  case GaugeSpec::Kind::contact_impulse:
    resolve_bodies(m, g);
    g.unit = spec.kind == GaugeSpec::Kind::contact_force ? "N" : "N s";
    g.reads_forces = spec.kind == GaugeSpec::Kind::contact_force;
    break;
  case GaugeSpec::Kind::impactor_displacement:
  case GaugeSpec::Kind::impactor_velocity:
    resolve_impactor(m, g);
    g.unit = spec.kind == GaugeSpec::Kind::impactor_displacement ? "m" : "m/s";
    break;
  case GaugeSpec::Kind::crack_width:
    resolve_line(g);
    resolve_crossings(m, g);
    g.unit = "m";
    break;
  case GaugeSpec::Kind::mean_strain:
    resolve_line(g);
    g.from = nearest_node(m, spec.from);
    g.to = nearest_node(m, spec.to);
    g.length = norm(mean_position(m, g.to) - mean_position(m, g.from));
    g.unit = "-";
    if (!(g.length > 0))
      throw core::InputError(spec.place,
                             fmt::format("gauge `{}`: both ends are nearest to the same node", spec.name));
    break;
  }
  for (std::size_t i = 0; i < m.stages.size(); ++i)
    if (!spec.zero_at.empty() && m.stages[i].name == spec.zero_at) g.zero_stage = static_cast<int>(i);
  return g;
}

/// Sum of the jumps across the joints on the line, along the line.
double crack_width(Model const& m, State const& s, Gauge const& g) {
  double width = 0;
  for (auto const& c : g.crossings) {
    auto const& joint = m.joints.joints[c.joint];
    Vec3 jump;
    for (int k = 0; k < 3; ++k)
      jump +=
          c.weight[k] * (mean_displacement(s, {joint.node_b[k]}) - mean_displacement(s, {joint.node_a[k]}));
    auto const normal = concrete::joint_kinematics(m, s, c.joint).normal;
    width += dot(jump, g.along) * (dot(normal, g.along) >= 0 ? 1 : -1);
  }
  return width;
}

double mean_strain(Model const& m, State const& s, Gauge const& g) {
  Vec3 const a = mean_position(m, g.from) + mean_displacement(s, g.from);
  Vec3 const b = mean_position(m, g.to) + mean_displacement(s, g.to);
  return norm(b - a) / g.length - 1;
}

double bar_reading(State const& s, Gauge const& g) {
  auto const& b = s.bars;
  auto const joint = static_cast<std::size_t>(std::max(0, g.bar_joint));
  if (g.spec.quantity == "stress") return b.element_stress[static_cast<std::size_t>(g.bar_element)];
  if (g.spec.quantity == "joint_stress") return b.joint_stress[joint];
  if (g.spec.quantity == "joint_strain") return b.joint_strain[joint];
  if (g.spec.quantity == "slip") return b.slip[joint];
  if (g.spec.quantity == "normalised_slip") return b.normalised_slip[joint];
  return b.dowel_force[joint];
}

/// Of planes and impactors, summed.
double body_reading(State const& s, Gauge const& g) {
  double sum = 0;
  for (int const i : g.bodies) {
    auto const& b = s.rigid.body[static_cast<std::size_t>(i)];
    sum += (g.spec.kind == GaugeSpec::Kind::contact_force           ? b.force
            : g.spec.kind == GaugeSpec::Kind::contact_impulse       ? b.impulse
            : g.spec.kind == GaugeSpec::Kind::impactor_displacement ? b.u
                                                                    : b.v)[g.spec.axis];
  }
  return sum;
}

double force_along(Model const& m, State const& s, Gauge const& g, double time) {
  double sum = 0;
  for (int const i : g.forces) {
    auto const& f = m.forces[i];
    sum += loads::value_at(f.curve, s, time) * f.total()[g.spec.axis];
  }
  return sum;
}

/// What can be read of u_n before the step moves on.
double raw_state(Model const& m, State const& s, Gauge const& g) {
  switch (g.spec.kind) {
  case GaugeSpec::Kind::displacement:
    return mean_component(s.u, g.nodes, g.spec.axis);
  case GaugeSpec::Kind::velocity:
    return mean_component(s.v, g.nodes, g.spec.axis);
  case GaugeSpec::Kind::crack_width:
    return crack_width(m, s, g);
  case GaugeSpec::Kind::contact_impulse:
  case GaugeSpec::Kind::impactor_displacement:
  case GaugeSpec::Kind::impactor_velocity:
    return body_reading(s, g);
  default:
    return mean_strain(m, s, g);
  }
}

/// What the step has to find first.
double raw_force(Model const& m, State const& s, Gauge const& g, double time) {
  if (g.spec.kind == GaugeSpec::Kind::bar) return bar_reading(s, g);
  if (g.spec.kind == GaugeSpec::Kind::contact_force) return body_reading(s, g);
  double sum = force_along(m, s, g, time);
  for (int const p : g.prescribed) sum += s.reaction[p];
  return sum;
}

} // namespace

Gauges::Gauges(Model const& m) {
  std::vector<core::Diagnostic> wrong;
  for (auto const& spec : m.source.gauges) {
    try {
      gauges_.push_back(resolve(m, spec));
    } catch (core::InputError const& e) {
      wrong.insert(wrong.end(), e.diagnostics.begin(), e.diagnostics.end());
    }
  }
  if (!wrong.empty()) throw core::InputError(std::move(wrong));
  for (std::size_t i = 0; i < gauges_.size(); ++i)
    definitions_.push_back(deck::echo_item(m.source, "gauge", i));
  is_new_.assign(gauges_.size(), false);
  zero_.assign(gauges_.size(), 0);
  values_.assign(gauges_.size(), 0);
  zeroed_.assign(gauges_.size(), 0);
}

std::vector<SavedGauge> Gauges::saved() const {
  std::vector<SavedGauge> list;
  for (std::size_t i = 0; i < gauges_.size(); ++i)
    list.push_back({definitions_[i], zero_[i], values_[i], zeroed_[i] != 0});
  return list;
}

void Gauges::go_on_from(std::vector<SavedGauge> const& saved, Model const& m, State const& s) {
  for (std::size_t i = 0; i < gauges_.size(); ++i) {
    auto const found = std::find_if(saved.begin(), saved.end(),
                                    [&](auto const& g) { return g.definition == definitions_[i]; });
    is_new_[i] = found == saved.end();
    if (!is_new_[i]) {
      zero_[i] = found->zero, values_[i] = found->value, zeroed_[i] = found->is_zeroed;
      continue;
    }
    auto const& g = gauges_[i];
    if (g.zero_stage >= 0 && g.zero_stage <= s.stage && s.step > 0)
      throw core::InputError(
          g.spec.place,
          fmt::format("gauge `{}` was not read when the stage `{}` began, before the checkpoint: its zero is "
                      "not known; leave `zero_at` out, name a later stage, or run it anew",
                      g.spec.name, m.stages[static_cast<std::size_t>(g.zero_stage)].name));
  }
}

std::vector<output::Column> Gauges::columns() const {
  std::vector<output::Column> c;
  for (auto const& g : gauges_) c.push_back({g.spec.name, g.unit});
  return c;
}

int Gauges::find(std::string const& name) const {
  for (std::size_t i = 0; i < gauges_.size(); ++i)
    if (gauges_[i].spec.name == name) return static_cast<int>(i);
  return -1;
}

void Gauges::store(std::size_t i, double raw) {
  auto const& g = gauges_[i];
  if (g.zero_stage == 0 && !zeroed_[i]) zero_[i] = raw, zeroed_[i] = 1;
  values_[i] = g.spec.factor * (raw - zero_[i]);
}

void Gauges::begin_stage(Model const& m, State const& s) {
  for (std::size_t i = 0; i < gauges_.size(); ++i) {
    auto const& g = gauges_[i];
    if (g.zero_stage != s.stage) continue;
    zero_[i] = g.reads_forces ? raw_force(m, s, g, s.load_time()) : raw_state(m, s, g);
    zeroed_[i] = 1;
  }
}

void Gauges::read_state(Model const& m, State const& s) {
  for (std::size_t i = 0; i < gauges_.size(); ++i)
    if (!gauges_[i].reads_forces) store(i, raw_state(m, s, gauges_[i]));
}

void Gauges::read_forces(Model const& m, State const& s, double time) {
  for (std::size_t i = 0; i < gauges_.size(); ++i)
    if (gauges_[i].reads_forces) store(i, raw_force(m, s, gauges_[i], time));
}

} // namespace fissura::sim
