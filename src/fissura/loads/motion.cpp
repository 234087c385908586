#include <cmath>

#include "fissura/loads/curve.hpp"
#include "fissura/loads/loads.hpp"

namespace fissura::loads {

using model::Model;
using state::State;

namespace {

/// Prescribed velocity at n + 1/2.
double velocity_of(model::Prescribed const& p, Model const& m, State const& s) {
  if (p.is_velocity) return value_at(p.motion, s, s.time + 0.5 * m.dt);
  return (value_at(p.motion, s, s.time + m.dt) - value_at(p.motion, s, s.time)) / m.dt;
}

/// The step of one component of one node as the tet pass did it, and how to undo it.
struct FreeStep {
  double keep, scale, alpha, dt, c;

  /// Acceleration without damping, from the velocity before and the one the free node would have reached.
  double acceleration(double before, double free) const {
    double const damped = (free / scale - keep * before) / dt;
    double const sense = before > 0 ? 1 : before < 0 ? -1 : 0;
    double const sign = damped > 0 ? 1 : damped < 0 ? -1 : 0;
    return damped / (1 - alpha * sign * sense);
  }
};

} // namespace

MotionEffects move_supports(Model const& m, State& s, Vec3 gravity_mean) {
  auto const& stage = current_stage(m, s);
  double const c = stage.mass_damping, dt = m.dt;
  FreeStep const step{1 - 0.5 * c * dt, 1 / (1 + 0.5 * c * dt), stage.local_damping, dt, c};
  MotionEffects sum;
  for (std::size_t i = 0; i < m.prescribed.size(); ++i) {
    auto const& p = m.prescribed[i];
    if (p.motion.stage > s.stage) continue; // its points are free until the stage begins
    double const before = s.prescribed_velocity[i], now = velocity_of(p, m, s);
    double reaction = 0;
    for (int const node : p.nodes) {
      double& v = s.v[4 * node + p.axis];
      double& u = s.u[4 * node + p.axis];
      double const free = v, mass = m.mass[node];
      double const a = step.acceleration(before, free);
      reaction += mass * ((now - before) / dt + 0.5 * c * (before + now) - a);
      sum.kinetic += 0.125 * mass * ((before + now) * (before + now) - (before + free) * (before + free));
      sum.local_damping -= step.alpha * mass * std::abs(a) * std::abs(before) * dt;
      sum.gravity += mass * m.tets.weight_ratio[node / 4] * gravity_mean[p.axis] * (now - free) * dt;
      u += dt * (now - free);
      v = now;
    }
    s.reaction[i] = reaction;
    sum.work_done += 0.5 * reaction * before * dt;
    sum.work_next += 0.5 * reaction * now * dt;
    s.prescribed_velocity[i] = now;
  }
  return sum;
}

} // namespace fissura::loads
