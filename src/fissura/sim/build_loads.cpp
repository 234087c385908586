#include <algorithm>
#include <fmt/core.h>
#include <map>
#include <set>

#include "fissura/model/record.hpp"
#include "fissura/model/select.hpp"
#include "fissura/sim/build_model.hpp"

namespace fissura::sim {

using model::Model;

namespace {

/// All node copies at each mesh point.
class Copies {
 public:
  explicit Copies(mesh::Mesh const& mesh) : start_(mesh.points.size() + 1, 0), node_(4 * mesh.tets.size()) {
    for (auto const& t : mesh.tets)
      for (int p : t) ++start_[p + 1];
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    std::vector<int> fill(start_.begin(), start_.end() - 1);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      for (int a = 0; a < 4; ++a) node_[fill[mesh.tets[t][a]]++] = model::node_of(static_cast<int>(t), a);
  }
  std::span<int const> of(int point) const {
    return {node_.data() + start_[point], node_.data() + start_[point + 1]};
  }

 private:
  std::vector<int> start_, node_;
};

int stage_number(Model const& m, std::string const& name, core::Place const& place) {
  if (name.empty()) return -1;
  for (std::size_t i = 0; i < m.stages.size(); ++i)
    if (m.stages[i].name == name) return static_cast<int>(i);
  throw core::InputError(place, fmt::format("there is no [[stage]] `{}`", name));
}

void build_stages(Model& m) {
  auto const& c = m.source;
  auto or_default = [](double own, double of_run) { return own >= 0 ? own : of_run; };
  for (auto const& s : c.stages)
    m.stages.push_back({s.name, s.duration, or_default(s.mass_damping, c.run.mass_damping),
                        or_default(s.local_damping, c.run.local_damping), s.settle});
  if (m.stages.empty())
    m.stages.push_back({"run", c.run.end_time, c.run.mass_damping, c.run.local_damping, 0});
}

/// Whether two items ask the same of a node: supports always do, motions where their curves are the same.
bool agree(model::Prescribed const& a, model::Prescribed const& b) {
  auto const& c = a.motion.curve;
  auto const& d = b.motion.curve;
  auto const rests = [](model::Prescribed const& p) {
    return p.path < 0 && p.motion.stage < 0 && p.motion.curve.kind == model::Curve::Kind::constant &&
           p.motion.curve.value == 0;
  };
  if (rests(a) && rests(b)) return true;
  return a.is_velocity == b.is_velocity && a.motion.stage == b.motion.stage && a.path == b.path &&
         (a.path < 0 || a.scale == b.scale) && c.kind == d.kind && c.value == d.value && c.over == d.over &&
         c.times == d.times && c.values == d.values && c.slopes == d.slopes && c.peaks == d.peaks &&
         c.period == d.period && c.repeats == d.repeats && c.one_sided == d.one_sided;
}

/// Which item prescribes each (node, axis). Items that agree may share points: the first in the deck,
/// supports before motions, holds them and books their reaction; those that do not would fight over them.
class Owners {
 public:
  explicit Owners(Model& m) : m_(m) {}

  /// Adds the item, without the nodes that an earlier one holds in the same way.
  void add(model::Prescribed p, core::Place const& place) {
    auto const mine = m_.prescribed.size();
    std::vector<int> nodes;
    std::map<std::size_t, std::set<int>> shared; ///< points, by the item that has them
    for (int const node : p.nodes) {
      auto const owner = owner_.try_emplace({node, p.axis}, mine).first->second;
      if (owner == mine) {
        nodes.push_back(node);
        continue;
      }
      if (!agree(m_.prescribed[owner], p)) refuse(p, m_.prescribed[owner], node, place);
      shared[owner].insert(m_.mesh.tets[static_cast<std::size_t>(node / 4)][node % 4]);
    }
    for (auto const& [owner, points] : shared)
      notes.push_back(fmt::format(
          "`{0}` and `{1}` hold {2} together along {3}: `{1}`, which comes first, takes their reaction{4}",
          p.name, m_.prescribed[owner].name,
          points.size() == 1 ? "a point" : fmt::format("{} points", points.size()), "xyz"[p.axis],
          nodes.empty() ? fmt::format(", and that of `{}` is zero", p.name) : ""));
    p.nodes = std::move(nodes);
    m_.prescribed.push_back(std::move(p));
  }

  std::vector<std::string> notes;

 private:
  [[noreturn]] void refuse(model::Prescribed const& p, model::Prescribed const& other, int node,
                           core::Place const& place) const {
    Vec3 const x =
        m_.mesh.points[static_cast<std::size_t>(m_.mesh.tets[static_cast<std::size_t>(node / 4)][node % 4])];
    throw core::InputError(
        place,
        fmt::format("`{}` and `{}` both prescribe the {} motion of the point at ({:.6g}, {:.6g}, {:.6g}) "
                    "m, and not alike; let them select different points or components",
                    p.name, other.name, "xyz"[p.axis], x.x, x.y, x.z));
  }

  Model& m_;
  std::map<std::pair<int, int>, std::size_t> owner_; ///< index into Model::prescribed
};

std::vector<int> nodes_at(Model const& m, Copies const& copies, model::Selector const& where) {
  std::vector<int> nodes;
  for (int const point : model::select_points(m.mesh, where))
    for (int const node : copies.of(point)) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

int gauge_number(Model const& m, model::PathSpec::Target const& target) {
  for (std::size_t i = 0; i < m.source.gauges.size(); ++i)
    if (m.source.gauges[i].name == target.gauge) return static_cast<int>(i);
  throw core::InputError(target.place, fmt::format("there is no [[gauge]] `{}`", target.gauge));
}

void build_paths(Model& m) {
  for (auto const& s : m.source.motions) {
    if (!s.path || !s.path->of.empty()) continue;
    model::MotionPath path{
        s.name, stage_number(m, s.stage, s.place), s.path->speed, s.path->turn, s.path->stops, {}};
    for (auto const& target : s.path->targets)
      path.targets.push_back({gauge_number(m, target), target.value});
    m.paths.push_back(std::move(path));
  }
}

/// The motion follows its own path, or that of the motion it names.
void follow(Model const& m, model::MotionSpec const& s, model::Prescribed& p) {
  auto const& owner = s.path->of.empty() ? s.name : s.path->of;
  for (std::size_t i = 0; i < m.paths.size(); ++i)
    if (m.paths[i].name == owner) p.path = static_cast<int>(i);
  if (p.path < 0)
    throw core::InputError(s.path->place, fmt::format("there is no [[motion]] `{}` with a path", owner));
  p.motion.stage = m.paths[static_cast<std::size_t>(p.path)].stage;
  p.scale = s.path->scale;
}

void take_record(model::MotionSpec const& s, model::Prescribed& p, BuildReport& report) {
  auto const record = model::read_record(*s.record);
  report.notes.insert(report.notes.end(), record.notes.begin(), record.notes.end());
  report.notes.push_back(fmt::format("motion `{}`: a record of {}", s.name, model::describe(record)));
  report.warnings.insert(report.warnings.end(), record.warnings.begin(), record.warnings.end());
  for (auto const& doubt : model::doubts(record))
    report.warnings.push_back(fmt::format("motion `{}`: {}", s.name, doubt));
  p.is_velocity = false;
  p.motion.curve = model::displacement_curve(record, s.record->start);
}

void build_prescribed(Model& m, Copies const& copies, BuildReport& report) {
  Owners owners(m);
  for (auto const& s : m.source.supports) {
    auto const nodes = nodes_at(m, copies, s.where);
    for (int axis = 0; axis < 3; ++axis)
      if (s.fix[axis]) owners.add({s.name, axis, true, {}, nodes}, s.place);
  }
  for (auto const& s : m.source.motions) {
    model::Prescribed p{s.name,
                        s.axis,
                        s.is_velocity,
                        {s.curve, stage_number(m, s.stage, s.place)},
                        nodes_at(m, copies, s.where)};
    if (s.record) take_record(s, p, report);
    if (s.path) follow(m, s, p);
    owners.add(std::move(p), s.place);
  }
  report.notes.insert(report.notes.end(), owners.notes.begin(), owners.notes.end());
}

/// Entries name a node at first; its overlay slot is known once all hosts are.
struct PendingEntry {
  int node;
  Vec3 share;
};
struct PendingForce {
  model::AppliedForce force;
  std::vector<PendingEntry> entries;
};

/// The total, shared equally among the points, and among the copies of a point by their mass: they move as
/// one.
PendingForce point_force(Model const& m, Copies const& copies, model::ForceSpec const& f) {
  PendingForce p;
  p.force.name = f.name;
  p.force.curve = {f.curve, stage_number(m, f.stage, f.place)};
  auto const points = model::select_points(m.mesh, f.where);
  for (int const point : points) {
    double mass = 0;
    for (int const node : copies.of(point)) mass += m.mass[node];
    for (int const node : copies.of(point))
      p.entries.push_back(
          {node, (m.mass[node] / mass / static_cast<double>(points.size())) * unit(f.direction)});
  }
  return p;
}

PendingForce traction(Model const& m, model::TractionSpec const& s) {
  PendingForce p;
  p.force.name = s.name;
  p.force.curve = {s.curve, stage_number(m, s.stage, s.place)};
  for (auto const& face : model::select_boundary_faces(m.mesh, m.adjacency, s.where)) {
    auto const& corner = mesh::face_corners[face.face];
    auto const x = mesh::corners(m.mesh, face.tet);
    Vec3 const area = 0.5 * cross(x[corner[1]] - x[corner[0]], x[corner[2]] - x[corner[0]]); // outwards
    Vec3 const along = s.normal ? -area : norm(area) * unit(s.direction);
    for (int const c : corner) p.entries.push_back({model::node_of(face.tet, c), (1.0 / 3) * along});
  }
  return p;
}

void build_forces(Model& m, Copies const& copies) {
  std::vector<PendingForce> pending;
  for (auto const& f : m.source.forces) pending.push_back(point_force(m, copies, f));
  for (auto const& t : m.source.tractions) pending.push_back(traction(m, t));

  std::set<int> hosts;
  for (auto const& e : m.bars.elements) hosts.insert(e.tet);
  for (auto const& j : m.bars.joints) hosts.insert({j.tet_a, j.tet_b});
  for (auto const& p : pending)
    for (auto const& e : p.entries) hosts.insert(e.node / 4);
  m.overlay_tets.assign(hosts.begin(), hosts.end());

  for (auto& p : pending) {
    for (auto const& e : p.entries) {
      auto const slot = std::lower_bound(m.overlay_tets.begin(), m.overlay_tets.end(), e.node / 4);
      p.force.entries.push_back({static_cast<int>(slot - m.overlay_tets.begin()), e.node % 4, e.share});
    }
    m.forces.push_back(std::move(p.force));
  }
}

} // namespace

void build_loads(Model& m, BuildReport& report) {
  build_stages(m);
  Copies const copies(m.mesh);
  build_paths(m);
  build_prescribed(m, copies, report);
  build_forces(m, copies);
  auto const& g = m.source.gravity;
  m.gravity = {g.on, unit(g.direction), {g.curve, stage_number(m, g.stage, g.place)}};
}

} // namespace fissura::sim
