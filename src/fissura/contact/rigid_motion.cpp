#include "fissura/contact/rigid.hpp"

namespace fissura::contact {

using model::Model;
using state::State;

state::RigidState make_rigid_state(Model const& m) {
  state::RigidState r;
  r.body.resize(m.rigid.size());
  for (std::size_t i = 0; i < m.rigid.size(); ++i) r.body[i].v = m.rigid[i].velocity;
  return r;
}

ImpactorEffects move_impactors(Model const& m, State& s, Vec3 gravity, Vec3 gravity_mean) {
  ImpactorEffects effects;
  for (std::size_t i = 0; i < m.rigid.size(); ++i) {
    auto const& body = m.rigid[i];
    auto& b = s.rigid.body[i];
    b.impulse += m.dt * b.force;
    if (!body.is_impactor) continue;
    Vec3 const old = b.v;
    for (int r = 0; r < 3; ++r) {
      if (!body.moves[static_cast<std::size_t>(r)]) continue;
      b.v[r] += m.dt * (gravity[r] - b.force[r] / body.mass);
      b.u[r] += m.dt * b.v[r];
      effects.gravity += body.mass * gravity_mean[r] * b.v[r] * m.dt;
    }
    for (int r = 0; r < 3; ++r) effects.kinetic.add(body.mass, old[r], b.v[r]);
  }
  return effects;
}

} // namespace fissura::contact
