#pragma once
// A model with nothing but a mesh, its joints' laws and bars, driven by prescribed displacements.
#include <cmath>
#include <functional>

#include "fissura/rebar/rebar.hpp"
#include "rebar_case.hpp"

namespace fissura::test {

inline model::ConcreteSpec table_4_concrete() {
  model::ConcreteSpec c;
  c.E = 30.5e9, c.f_t = 3e6, c.f_c = 30e6, c.G_f = 130, c.penalty = 20 * c.E;
  return c;
}

struct BarModel {
  model::Model m;
  state::State s;
  state::Scratch w;
  double work = 0; ///< put in through the corners so far [J]

  BarModel(mesh::Mesh mesh, std::vector<model::BarSpec> bars, model::BarSettings settings = {},
           model::ConcreteSpec const& concrete = table_4_concrete()) {
    auto e = embed(std::move(mesh), bars);
    m.mesh = e.mesh, m.adjacency = e.adjacency, m.bars = e.embedding.bars;
    m.source.concretes = {concrete}, m.source.bars = bars, m.source.bar_settings = settings;
    m.source.steels = {table_4_steel()};
    m.material_of_tet.assign(m.mesh.tets.size(), 0);
    m.joint_of_shared_face = e.joint_of_shared_face;
    add_joint_laws(concrete);
    rebar::set_bar_joint_laws(m);
    place_nodes();
    s.bars = rebar::make_bar_state(m.bars);
    w.overlay =
        state::Overlay(model::blocks_for(m.mesh.tets.size()) * model::block, rebar::host_tets(m.bars));
    w.bars = rebar::make_bar_scratch(m, w.overlay);
  }

  /// Moves every corner of every tet to X + displacement(tet, X), computes the forces, and adds the work done
  /// over the way there, by the trapezoidal rule, to `work`.
  void move(std::function<Vec3(int, Vec3)> const& displacement) {
    std::vector<double> const u_before(s.u.values.begin(), s.u.values.end());
    auto const force_before = w.overlay.force;
    for (int t = 0; t < static_cast<int>(m.mesh.tets.size()); ++t)
      for (int c = 0; c < 4; ++c) {
        Vec3 const u = displacement(t, corners(m.mesh, t)[c]);
        for (int r = 0; r < 3; ++r) {
          s.v(4 * t + c, r) = u[r] - s.u(4 * t + c, r); // dt is 1 s
          s.u(4 * t + c, r) = u[r];
        }
      }
    forces();
    for (std::size_t slot = 0; slot < w.overlay.tets.size(); ++slot)
      for (std::size_t k = 0; k < 12; ++k) {
        std::size_t const dof = 12 * static_cast<std::size_t>(w.overlay.tets[slot]) + k;
        work -= 0.5 * (force_before[12 * slot + k] + w.overlay.force[12 * slot + k]) *
                (s.u.values[dof] - u_before[dof]);
      }
  }

  void forces() {
    std::fill(w.overlay.force.begin(), w.overlay.force.end(), 0.0);
    rebar::bar_joint_forces(m, s, w);
    rebar::bar_forces(m, s, w);
    rebar::gather_bar_forces(m, w);
  }

  /// Resultant force and moment about the origin of all corner forces; the last entry is the sum of their
  /// sizes.
  struct Resultant {
    Vec3 force, moment;
    double size = 0;
  };
  Resultant resultant() const {
    Resultant r;
    for (std::size_t slot = 0; slot < w.overlay.tets.size(); ++slot)
      for (int c = 0; c < 4; ++c) {
        int const node = 4 * w.overlay.tets[slot] + c;
        double const* f = w.overlay.at(static_cast<int>(slot)) + 3 * c;
        Vec3 const force{f[0], f[1], f[2]};
        Vec3 x = corners(m.mesh, w.overlay.tets[slot])[c];
        x += s.u.at(node);
        r.force += force;
        r.moment += cross(x, force);
        r.size += norm(force);
      }
    return r;
  }

  rebar::BarEnergy energy() const { return rebar::bar_energy(m.bars, s.bars); }
  double booked() const {
    auto const e = energy();
    return e.elements + e.joints + e.bond_steel + e.dowel + e.rupture;
  }

 private:
  void add_joint_laws(model::ConcreteSpec const& c) {
    m.joints.count = static_cast<int>(m.adjacency.shared.size());
    m.joints.stiffness = core::Buffer<double>(2 * m.joints.blocks() * model::block);
    for (auto const& shared : m.adjacency.shared) {
      laws::CohesiveInput in;
      in.p = c.penalty, in.f_t = c.f_t, in.G_f = c.G_f, in.crackable = c.crackable;
      in.h = geometry::regular_edge(0.5 * (geometry::volume(corners(m.mesh, shared.a.tet)) +
                                           geometry::volume(corners(m.mesh, shared.b.tet))));
      in.friction_angle = c.friction_angle;
      in.cohesion = c.f_c * (1 - std::sin(c.friction_angle)) / (2 * std::cos(c.friction_angle));
      auto const law = laws::make_cohesive_params(in);
      m.joints.stiffness[model::at(m.joints.kind.size(), 0, 2)] = law.k;
      m.joints.add({}, law);
    }
  }

  void place_nodes() {
    m.position = core::NodeField(4 * m.mesh.tets.size());
    s.u = core::NodeField(4 * m.mesh.tets.size());
    s.v = core::NodeField(4 * m.mesh.tets.size());
    m.dt = 1;
    for (int t = 0; t < static_cast<int>(m.mesh.tets.size()); ++t)
      for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r) m.position(4 * t + c, r) = corners(m.mesh, t)[c][r];
  }
};

/// Two tets on both sides of a triangle near the plane x = 0; the corner on side b lies at x = +size, on side
/// a at -size.
inline mesh::Mesh two_tets(double size, double tilt = 0) {
  mesh::Mesh m;
  m.points = {{-size, 0, 0},
              {size, 0, 0},
              {tilt * size, size, 0},
              {0, -0.5 * size, 0.87 * size},
              {0, -0.5 * size, -0.87 * size}};
  m.tets = {{0, 2, 3, 4}, {1, 2, 4, 3}};
  for (auto& t : m.tets)
    if (geometry::volume({m.points[t[0]], m.points[t[1]], m.points[t[2]], m.points[t[3]]}) < 0)
      std::swap(t[2], t[3]);
  m.tet_group = {0, 0};
  m.volume_groups = {"concrete"};
  m.input_id = {0, 1};
  return m;
}

} // namespace fissura::test
