#include <cmath>

#include "fissura/loads/curve.hpp"
#include "fissura/loads/free_step.hpp"
#include "fissura/loads/loads.hpp"
#include "fissura/loads/path.hpp"
#include "fissura/parallel/parallel.hpp"

namespace fissura::loads {

using model::Model;
using state::State;

namespace {

constexpr std::size_t nodes_per_chunk = 512;

/// Prescribed velocity at n + 1/2.
double velocity_of(model::Prescribed const& p, Model const& m, State const& s) {
  if (p.path >= 0) {
    auto const i = static_cast<std::size_t>(p.path);
    return p.scale * s.pace * path_velocity(m.paths[i], s.paths[i], s.load_time(0.5 * m.dt));
  }
  if (p.is_velocity) return s.pace * value_at(p.motion, s, s.load_time(0.5 * m.dt));
  return (value_at(p.motion, s, s.load_time(m.dt)) - value_at(p.motion, s, s.load_time())) / m.dt;
}

/// What imposing one prescribed component did to a range of its nodes.
struct NodeSums {
  double reaction = 0, gravity = 0, local_damping = 0;
  state::Kinetic kinetic;
  NodeSums& operator+=(NodeSums const& b) {
    reaction += b.reaction, kinetic += b.kinetic, gravity += b.gravity, local_damping += b.local_damping;
    return *this;
  }
};

NodeSums impose(model::Prescribed const& p, Model const& m, State& s, FreeStep const& step, double before,
                double now, double gravity, std::size_t begin, std::size_t end) {
  NodeSums sum;
  for (std::size_t i = begin; i < end; ++i) {
    int const node = p.nodes[i];
    double& v = s.v(node, p.axis);
    double const free = v, mass = m.mass[node], a = step.acceleration(before, free);
    sum.reaction += mass * ((now - before) / step.dt + 0.5 * step.c * (before + now) - a);
    sum.kinetic.add(mass, before, now), sum.kinetic.add(-mass, before, free);
    double const sense = before > 0 ? 1 : before < 0 ? -1 : 0;
    sum.local_damping -= step.alpha * mass * std::abs(a) * sense * 0.5 * (before + free) * step.dt;
    sum.gravity += mass * m.tets.weight_ratio[node / 4] * gravity * (now - free) * step.dt;
    s.u(node, p.axis) += step.dt * (now - free);
    v = now;
  }
  return sum;
}

} // namespace

void next_velocities(Model const& m, State const& s, std::vector<double>& driven) {
  driven.resize(m.prescribed.size());
  for (std::size_t i = 0; i < m.prescribed.size(); ++i)
    if (m.prescribed[i].motion.stage <= s.stage) driven[i] = velocity_of(m.prescribed[i], m, s);
}

MotionEffects book_reactions(Model const& m, State& s, std::span<double const> driven,
                             std::span<double const> reaction) {
  MotionEffects effects;
  for (std::size_t i = 0; i < m.prescribed.size(); ++i) {
    if (m.prescribed[i].motion.stage > s.stage) continue;
    effects.work_done += 0.5 * reaction[i] * s.prescribed_velocity[i] * m.dt;
    effects.work_next += 0.5 * reaction[i] * driven[i] * m.dt;
    s.reaction[i] = reaction[i];
    s.prescribed_velocity[i] = driven[i];
  }
  return effects;
}

bool begins_now(Model const& m, State const& s) {
  for (std::size_t i = 0; i < m.prescribed.size(); ++i)
    if (!s.held[i] && m.prescribed[i].motion.stage <= s.stage) return true;
  return false;
}

double take_hold(Model const& m, State& s) {
  double work = 0;
  for (std::size_t i = 0; i < m.prescribed.size(); ++i) {
    auto const& p = m.prescribed[i];
    if (s.held[i] || p.motion.stage > s.stage) continue;
    s.held[i] = 1;
    for (int const node : p.nodes) {
      double& v = s.v(node, p.axis);
      work -= 0.5 * m.mass[node] * v * v;
      v = s.prescribed_velocity[i];
    }
  }
  return work;
}

MotionEffects move_supports(Model const& m, State& s, Vec3 gravity_mean) {
  FreeStep const step = free_step(current_stage(m, s), m.dt);
  double const dt = m.dt;
  MotionEffects effects;
  for (std::size_t i = 0; i < m.prescribed.size(); ++i) {
    auto const& p = m.prescribed[i];
    if (p.motion.stage > s.stage) continue; // its points are free until the stage begins
    double const before = s.prescribed_velocity[i], now = velocity_of(p, m, s);
    auto const sum = parallel::sum_chunks<NodeSums>(
        p.nodes.size(), nodes_per_chunk, [&](std::size_t begin, std::size_t end) {
          return impose(p, m, s, step, before, now, gravity_mean[p.axis], begin, end);
        });
    s.reaction[i] = sum.reaction;
    s.prescribed_velocity[i] = now;
    effects.kinetic += sum.kinetic;
    effects.gravity += sum.gravity;
    effects.local_damping += sum.local_damping;
    effects.work_done += 0.5 * sum.reaction * before * dt;
    effects.work_next += 0.5 * sum.reaction * now * dt;
  }
  return effects;
}

} // namespace fissura::loads
