#include "fissura/sim/stages.hpp"

#include "fissura/loads/curve.hpp"
#include "fissura/loads/path.hpp"

namespace fissura::sim {

using model::Model;
using state::State;

namespace {

double length_from(Model const& m, int stage) {
  double sum = 0;
  for (auto i = static_cast<std::size_t>(stage); i < m.stages.size(); ++i) sum += m.stages[i].duration;
  return sum;
}

/// Whether a load is still on its way: a slow ramp is quiet, but not over; a steady velocity never ends.
bool loads_change(Model const& m, State const& s) {
  auto changes = [&](model::TimedCurve const& c) {
    if (c.stage > s.stage) return false;
    return s.load_time() - (c.stage < 0 ? c.start : s.stage_start[c.stage]) < loads::length_of(c.curve);
  };
  bool any = m.gravity.on && changes(m.gravity.curve);
  for (std::size_t i = 0; i < m.prescribed.size(); ++i)
    any |= changes(m.prescribed[i].motion) || (m.prescribed[i].is_velocity && s.prescribed_velocity[i] != 0);
  for (std::size_t i = 0; i < m.paths.size(); ++i)
    any |= m.paths[i].stage <= s.stage && !loads::path_ended(m.paths[i], s.paths[i]);
  for (auto const& f : m.forces) any |= changes(f.curve);
  return any;
}

} // namespace

double planned_end(Model const& m) {
  return m.source.run.end_time > 0 ? m.source.run.end_time : length_from(m, 0);
}

Stages::Stages(Model const& m) : end_(planned_end(m)) {}

void Stages::go_on_from(Model const& m, State const& s) {
  bool const has_settled = settled_ >= 3 && s.stage + 1 == static_cast<int>(m.stages.size());
  if (has_settled) return;
  end_ = m.source.run.end_time > 0 ? m.source.run.end_time : s.stage_start[s.stage] + length_from(m, s.stage);
}

bool Stages::is_over(Model const& m, State const& s) const {
  return s.stage + 1 < static_cast<int>(m.stages.size()) &&
         s.load_time() - s.stage_start[s.stage] >= m.stages[s.stage].duration;
}

bool Stages::go_on(Model const& m, State& s, bool is_quiet) {
  double const now = s.load_time();
  settled_ = is_quiet && !loads_change(m, s) ? settled_ + 1 : 0;
  bool const has_settled = settled_ >= 3;
  if (now - s.stage_start[s.stage] < m.stages[s.stage].duration && !has_settled) return false;
  if (s.stage + 1 >= static_cast<int>(m.stages.size())) {
    if (has_settled) end_ = now;
    return false;
  }
  settled_ = 0;
  double const damping = m.stages[s.stage].mass_damping;
  s.stage_start[++s.stage] = now;
  // The step books c dt (K before + K now) with one c: the first half of the next one still has the old c.
  s.ledger.mass_damping += (damping - m.stages[s.stage].mass_damping) * m.dt * s.ledger.kinetic_before;
  // A stage that has settled early brings the end of the run forward.
  if (!(m.source.run.end_time > 0)) end_ = now + length_from(m, s.stage);
  return true;
}

} // namespace fissura::sim
