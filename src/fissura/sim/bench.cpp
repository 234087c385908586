#include "fissura/sim/bench.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

#include "fissura/concrete/kernels.hpp"
#include "fissura/parallel/parallel.hpp"
#include "fissura/sim/build_model.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/step/advance.hpp"

namespace fissura::sim {

namespace {

model::Case cube(int cells) {
  model::Case c;
  model::BoxSpec box;
  double const edge = 0.05 * cells;
  box.to = {edge, edge, edge};
  box.cells = {cells, cells, cells};
  c.mesh.boxes = {box};
  model::ConcreteSpec concrete;
  concrete.name = "concrete";
  concrete.E = 30e9;
  concrete.f_t = 3e6;
  concrete.f_c = 30e6;
  c.concretes = {concrete};
  c.run.end_time = 1;
  return c;
}

/// Every node its own small velocity, so that nothing is trivially zero.
void shake(model::Model const& m, state::State& s) {
  for (int node = 0; node < 4 * m.tet_count(); ++node)
    for (int r = 0; r < 3; ++r) s.v[4 * node + r] = 1e-6 * ((node * 7 + r * 3) % 11 - 5);
}

} // namespace

std::string bench(BenchOptions const& options) {
  parallel::Threads const threads(options.threads);
  int const cells =
      std::max(1, static_cast<int>(std::lround(std::cbrt(static_cast<double>(options.tets) / 6))));
  BuildReport report;
  auto const m = build_model(cube(cells), report);
  auto s = step::make_state(m);
  auto w = step::make_scratch(m);
  shake(m, s);
  Monitor monitor(m);
  step::EnergyBalance energy;
  auto one = [&] {
    bool const reading = s.step % m.source.run.energy_every == 0;
    step::advance(m, s, w, reading ? &energy : nullptr);
    if (reading) monitor.take(energy, m, s);
  };
  for (int i = 0; i < 5; ++i) one();
  long const steps = options.steps > 0
                         ? options.steps
                         : std::max(50L, static_cast<long>(2e7 * threads.count() / m.tet_count()));
  auto const start = std::chrono::steady_clock::now();
  for (long i = 0; i < steps; ++i) one();
  double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  double const each = seconds / (static_cast<double>(steps) * m.tet_count());
  return fmt::format("uncracked cube: {} tets, {} joints, {} threads, kernels {}, {} steps: {:.2f} ns per "
                     "tet-step ({:.2f} million per second)\n",
                     m.tet_count(), m.joint_count(), threads.count(), concrete::kernels().name, steps,
                     each * 1e9, 1e-6 / each);
}

} // namespace fissura::sim
