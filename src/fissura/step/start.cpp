#include "fissura/step/start.hpp"

namespace fissura::step {

using model::Model;
using state::State;

void set_in_motion(Model const& m, State& s) {
  for (auto const& given : m.initial_velocity)
    for (int const node : given.nodes)
      for (int r = 0; r < 3; ++r) s.v(node, r) = given.velocity[r];
  for (std::size_t c = 0; c + 1 < m.bonding.start.size(); ++c)
    for (int r = 0; r < 3; ++r) {
      double mass = 0, momentum = 0;
      for (int i = m.bonding.start[c]; i < m.bonding.start[c + 1]; ++i) {
        mass += m.mass[m.bonding.node[i]];
        momentum += m.mass[m.bonding.node[i]] * s.v(m.bonding.node[i], r);
      }
      for (int i = m.bonding.start[c]; i < m.bonding.start[c + 1]; ++i)
        s.v(m.bonding.node[i], r) = momentum / mass;
    }
  for (auto const& p : m.prescribed)
    if (p.motion.stage <= 0)
      for (int const node : p.nodes) s.v(node, p.axis) = 0;
}

double kinetic_energy(Model const& m, State const& s) {
  double sum = 0;
  for (std::size_t n = 0; n < 4 * static_cast<std::size_t>(m.tets.count); ++n) {
    Vec3 const v = s.v.at(n);
    sum += 0.5 * m.mass[n] * dot(v, v);
  }
  for (std::size_t i = 0; i < m.rigid.size(); ++i)
    sum += 0.5 * m.rigid[i].mass * dot(s.rigid.body[i].v, s.rigid.body[i].v);
  return sum;
}

} // namespace fissura::step
