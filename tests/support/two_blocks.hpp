#pragma once
// Two elastic blocks that meet, for the tests of contact.
#include <cmath>

#include "support/cases.hpp"

namespace fissura::support {

/// Soft concrete without joints, so that steps are long and blocks deform visibly.
inline model::ConcreteSpec soft_material(std::string name, std::vector<std::string> groups,
                                         bool joints = false) {
  auto c = plain_concrete();
  c.name = std::move(name);
  c.groups = std::move(groups);
  c.E = 1e8, c.nu = 0.2, c.density = 2500, c.penalty = 20 * c.E;
  c.joints = joints;
  c.crackable = false;
  return c;
}

inline model::BoxSpec block_of(std::string name, Vec3 from, Vec3 to, std::array<int, 3> cells) {
  auto b = box_of_cells(name, from, to, cells);
  b.body = name;
  return b;
}

/// Two blocks of one soft material; velocities are given by the test.
inline model::Case two_blocks(model::BoxSpec first, model::BoxSpec second, double friction,
                              bool joints = false) {
  auto c = box_case({1, 1, 1}, {1, 1, 1}, 1);
  c.concretes = {soft_material("soft", {}, joints)};
  c.mesh.boxes = {std::move(first), std::move(second)};
  c.contact.friction = friction;
  return c;
}

struct Motion {
  Vec3 momentum, spin; ///< [kg m/s], [kg m2/s] about the origin
  double kinetic = 0;  ///< [J]
};
/// Of the tets of one volume group (-1: all), with velocities at n - 1/2 and positions at n.
inline Motion motion_of(Stepper const& t, int group = -1) {
  Motion sum;
  for (int tet = 0; tet < t.m.tet_count(); ++tet) {
    if (group >= 0 && t.m.mesh.tet_group[tet] != group) continue;
    for (int c = 0; c < 4; ++c) {
      int const node = model::node_of(tet, c);
      Vec3 const x = t.m.position.at(node) + t.s.u.at(node), v = t.s.v.at(node);
      double const mass = t.m.mass[node];
      sum.momentum += mass * v;
      sum.spin += mass * cross(x, v);
      sum.kinetic += 0.5 * mass * dot(v, v);
    }
  }
  return sum;
}

inline void set_velocity(Stepper& t, int group, Vec3 v) {
  for (int tet = 0; tet < t.m.tet_count(); ++tet) {
    if (t.m.mesh.tet_group[tet] != group) continue;
    for (int c = 0; c < 4; ++c)
      for (int r = 0; r < 3; ++r) t.s.v(model::node_of(tet, c), r) = v[r];
  }
}

} // namespace fissura::support
