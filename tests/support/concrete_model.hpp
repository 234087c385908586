#pragma once
// Models for tests straight from a mesh: concrete only, or (reinforced_model.hpp) with bars. No deck, no
// loads.
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "fissura/concrete/concrete.hpp"
#include "fissura/model/make_blocks.hpp"
#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"
#include "support/random_mesh.hpp"

namespace fissura::support {

/// C30 with a round fracture energy.
inline model::ConcreteSpec plain_concrete() {
  model::ConcreteSpec c;
  c.name = "concrete";
  c.E = 30e9, c.nu = 0.2, c.density = 2500;
  c.f_t = 3e6, c.f_c = 30e6, c.G_f = 120;
  return c;
}

/// A concrete that stays elastic whatever a test does to it, while its joints keep their stiffness and can be
/// told to have cracked.
inline model::ConcreteSpec unbreakable_concrete() {
  auto c = plain_concrete();
  c.f_t = 1e12, c.cohesion = 1e12, c.f_c = 30e6, c.G_f = 1e12;
  return c;
}

/// One stage that lasts for ever, without damping.
inline void add_stage(model::Model& m) {
  m.stages = {model::Stage{"run", 1e9, 0, 0, 0}};
}

/// The mesh in one concrete; dt is left to the test.
inline model::Model concrete_model(mesh::Mesh mesh, model::ConcreteSpec const& concrete = plain_concrete()) {
  model::Model m;
  m.source.concretes = {concrete};
  m.mesh = std::move(mesh);
  m.adjacency = mesh::make_adjacency(m.mesh);
  m.material_of_tet = model::assign_materials(m.source, m.mesh);
  model::make_blocks(m);
  add_stage(m);
  return m;
}

/// A box of equal cells of 6 tets.
inline mesh::Mesh box_mesh(std::array<int, 3> cells, Vec3 size, int tets_per_cell = 6) {
  mesh::BoxCells box;
  box.to = size;
  box.cells = cells;
  box.tets_per_cell = tets_per_cell;
  return mesh::make_boxes({&box, 1});
}

inline std::size_t node_slots(model::Model const& m) {
  return 4 * m.tets.blocks() * model::block;
}
inline int node_count(model::Model const& m) {
  return 4 * m.tet_count();
}

inline Vec3 position(model::Model const& m, int node) {
  return m.position.at(node);
}
inline Vec3 at_node(core::NodeField const& field, int node) {
  return field.at(node);
}
inline void set_node(core::NodeField& field, int node, Vec3 value) {
  for (int r = 0; r < 3; ++r) field(node, r) = value[r];
}
/// field(node) = value(X) at the reference position X, for all nodes of all tets.
inline void set_field(model::Model const& m, core::NodeField& field, std::function<Vec3(Vec3)> const& value) {
  for (int n = 0; n < node_count(m); ++n) set_node(field, n, value(position(m, n)));
}

/// Rotation by an angle [rad] about an axis (Rodrigues), minus the identity: no digits are lost at small
/// angles.
inline Mat3 rotation_minus_identity(Vec3 axis, double angle) {
  Vec3 const n = unit(axis);
  Mat3 const N{{Vec3{0, -n.z, n.y}, Vec3{n.z, 0, -n.x}, Vec3{-n.y, n.x, 0}}};
  double const half = std::sin(0.5 * angle);
  return std::sin(angle) * N + (2 * half * half) * (N * N);
}

/// A state at rest that holds no bars: enough for the functions of `concrete`.
inline state::State concrete_state(model::Model const& m) {
  state::State s;
  s.u = core::NodeField(node_slots(m));
  s.v = core::NodeField(node_slots(m));
  s.joint_status = core::Buffer<std::uint8_t>(m.joints.blocks() * model::block);
  s.joint_history = state::JointHistories(m.joints.blocks() * model::block);
  s.stage_start.assign(m.stages.size(), 0);
  return s;
}
inline state::Scratch concrete_scratch(model::Model const& m) {
  state::Scratch w;
  w.joints = concrete::make_joint_slots(m, concrete_state(m));
  if (m.bonding.any) w.corner_force = core::NodeField(node_slots(m));
  w.overlay = state::Overlay(m.tets.blocks() * model::block, m.overlay_tets);
  w.tet_sums.resize(4 * m.tets.blocks() + 1);
  return w;
}

} // namespace fissura::support
