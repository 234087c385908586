// Rigid bodies and initial velocities, from the case to the model.
#include <algorithm>

#include "fissura/model/select.hpp"
#include "fissura/sim/build_model.hpp"

namespace fissura::sim {

using model::Model;
using model::RigidBody;

namespace {

RigidBody plane(model::PlaneSpec const& s) {
  RigidBody b;
  b.place = s.place;
  b.name = s.name;
  b.shape = RigidBody::Shape::plane;
  b.centre = s.point;
  b.axis = unit(s.normal);
  b.friction = s.friction;
  return b;
}

void set_shape(RigidBody& b, model::ImpactorSpec const& s) {
  using Shape = model::ImpactorSpec::Shape;
  Vec3 const span = s.to - s.from;
  b.centre = s.shape == Shape::sphere ? s.centre : 0.5 * (s.from + s.to);
  switch (s.shape) {
  case Shape::sphere:
    b.shape = RigidBody::Shape::sphere;
    b.radius = s.radius;
    break;
  case Shape::cylinder:
    b.shape = RigidBody::Shape::cylinder;
    b.radius = s.radius;
    b.half_length = 0.5 * norm(span);
    b.axis = unit(span);
    break;
  case Shape::box:
    b.shape = RigidBody::Shape::box;
    for (int i = 0; i < 3; ++i) b.half[i] = 0.5 * std::abs(span[i]);
    break;
  }
}

RigidBody impactor(model::ImpactorSpec const& s) {
  RigidBody b;
  b.place = s.place;
  b.name = s.name;
  b.friction = s.friction;
  b.is_impactor = true;
  b.mass = s.mass;
  b.velocity = s.velocity;
  b.moves = s.moves;
  set_shape(b, s);
  return b;
}

bool picks_nodes(Model const& m, model::Selector const& s) {
  using Kind = model::Selector::Kind;
  if (s.kind != Kind::group) return s.kind == Kind::plane || s.kind == Kind::point || s.kind == Kind::line;
  if (!model::names_tets(m.mesh, s)) return true;
  model::select_points(m.mesh, s); // refuses a name that also stands for other points
  return false;
}

/// Nodes of the tets picked; a plane, point or line picks the nodes on it.
std::vector<int> moving_nodes(Model const& m, model::Selector const& where) {
  std::vector<int> nodes;
  if (!picks_nodes(m, where)) {
    for (int const t : model::select_tets(m.mesh, where))
      for (int a = 0; a < 4; ++a) nodes.push_back(model::node_of(t, a));
    return nodes;
  }
  std::vector<char> picked(m.mesh.points.size(), 0);
  for (int const p : model::select_points(m.mesh, where)) picked[static_cast<std::size_t>(p)] = 1;
  for (int t = 0; t < m.tets.count; ++t)
    for (int a = 0; a < 4; ++a)
      if (picked[static_cast<std::size_t>(
              m.mesh.tets[static_cast<std::size_t>(t)][static_cast<std::size_t>(a)])])
        nodes.push_back(model::node_of(t, a));
  return nodes;
}

} // namespace

void build_rigid(Model& m) {
  for (auto const& s : m.source.planes) m.rigid.push_back(plane(s));
  for (auto const& s : m.source.impactors) m.rigid.push_back(impactor(s));
  for (auto const& s : m.source.initial_velocities)
    m.initial_velocity.push_back({moving_nodes(m, s.where), s.velocity});
}

} // namespace fissura::sim
