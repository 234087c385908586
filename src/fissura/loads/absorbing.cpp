// Lysmer's dashpots: force = -C v on the nodes of absorbing boundaries.
#include <cmath>

#include "fissura/loads/free_step.hpp"
#include "fissura/loads/loads.hpp"
#include "fissura/parallel/parallel.hpp"

namespace fissura::loads {

using model::Model;
using state::State;

namespace {

constexpr std::size_t patches_per_chunk = 256;

double sign(double x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// m (v' - v)/dt = f - c m (v + v')/2 - C (v + v')/2 with v* what it gives without C:
/// (1 + b C) v' = v* - b C v,  b = dt/(2 m (1 + c dt/2)).
Vec3 damped(model::Absorbing::Patch const& p, FreeStep const& step, Vec3 before, Vec3 free) {
  double const b = 0.5 * step.scale * step.dt / p.mass;
  return inverse(Mat3::identity() + b * p.damping) * (free - b * (p.damping * before));
}

AbsorbingEffects absorb(Model const& m, State& s, FreeStep const& step, model::Absorbing::Patch const& p,
                        Vec3 before, Vec3 gravity_mean) {
  Vec3 const free = s.v.at(m.absorbing.node[static_cast<std::size_t>(p.begin)]);
  Vec3 const now = damped(p, step, before, free), mid = 0.5 * (before + now),
             mid_free = 0.5 * (before + free);
  AbsorbingEffects e;
  e.absorbed = step.dt * dot(mid, p.damping * mid);
  e.gravity = p.mass * p.weight_ratio * step.dt * dot(gravity_mean, now - free);
  for (int r = 0; r < 3; ++r)
    e.kinetic.add(p.mass, before[r], now[r]), e.kinetic.add(-p.mass, before[r], free[r]);
  for (int r = 0; r < 3; ++r)
    e.local_damping += step.alpha * p.mass * std::abs(step.acceleration(before[r], free[r])) *
                       sign(before[r]) * (mid[r] - mid_free[r]) * step.dt;
  for (int i = p.begin; i < p.end; ++i) {
    int const node = m.absorbing.node[static_cast<std::size_t>(i)];
    for (int r = 0; r < 3; ++r) {
      s.u(node, r) += step.dt * (now[r] - free[r]);
      s.v(node, r) = now[r];
    }
  }
  return e;
}

} // namespace

void note_velocities(Model const& m, State const& s, state::Scratch& w) {
  for (std::size_t i = 0; i < m.absorbing.patches.size(); ++i)
    w.velocity_before[i] = s.v.at(m.absorbing.node[static_cast<std::size_t>(m.absorbing.patches[i].begin)]);
}

AbsorbingEffects absorb_waves(Model const& m, State& s, state::Scratch const& w, Vec3 gravity_mean) {
  FreeStep const step = free_step(current_stage(m, s), m.dt);
  return parallel::sum_chunks<AbsorbingEffects>(
      m.absorbing.patches.size(), patches_per_chunk, [&](std::size_t begin, std::size_t end) {
        AbsorbingEffects sum;
        for (std::size_t i = begin; i < end; ++i)
          sum += absorb(m, s, step, m.absorbing.patches[i], w.velocity_before[i], gravity_mean);
        return sum;
      });
}

} // namespace fissura::loads
