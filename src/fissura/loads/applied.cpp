#include "fissura/loads/curve.hpp"
#include "fissura/loads/loads.hpp"

namespace fissura::loads {

using model::Model;
using state::Scratch;
using state::State;

double value_at(model::TimedCurve const& c, State const& s, double t) {
  if (c.stage < 0) return value_at(c.curve, t - c.start);
  if (c.stage > s.stage) return 0;
  return value_at(c.curve, t - s.stage_start[c.stage]);
}

Vec3 gravity_at(Model const& m, State const& s, double t) {
  return m.gravity.on ? value_at(m.gravity.curve, s, t) * m.gravity.direction : Vec3{};
}

void applied_forces(Model const& m, State const& s, Scratch& w) {
  for (auto const& load : m.forces) {
    double const value = value_at(load.curve, s, s.load_time());
    if (value == 0) continue;
    for (auto const& e : load.entries) {
      double* const f = w.overlay.at(e.slot) + core::per_node * e.corner;
      for (int r = 0; r < 3; ++r) f[r] += value * e.share[r];
    }
  }
}

double applied_work(Model const& m, State const& s) {
  double work = 0;
  for (auto const& load : m.forces) {
    double const mean =
        0.5 * (value_at(load.curve, s, s.load_time()) + value_at(load.curve, s, s.load_time(m.dt)));
    double along = 0;
    for (auto const& e : load.entries) {
      along += dot(e.share, s.v.at(model::node_of(m.overlay_tets[e.slot], e.corner)));
    }
    work += mean * along * m.dt;
  }
  return work;
}

model::Stage const& current_stage(Model const& m, State const& s) {
  return m.stages[s.stage];
}

} // namespace fissura::loads
