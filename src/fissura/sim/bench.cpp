#include "fissura/sim/bench.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/core.h>

#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/kernels.hpp"
#include "fissura/parallel/parallel.hpp"
#include "fissura/sim/bench_scenes.hpp"
#include "fissura/sim/build_model.hpp"
#include "fissura/sim/guards.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/step/advance.hpp"

namespace fissura::sim {

namespace {

std::string what_joints(concrete::JointCounts const& n) {
  return n.damaged == 0 ? "" : fmt::format(" ({} damaged, {} of them broken)", n.damaged, n.broken);
}

} // namespace

std::string bench(BenchOptions const& options) {
  auto const& scene = bench_scene(options.scene);
  parallel::Threads const threads(options.threads);
  BuildReport report;
  auto const the_case = scene.make_case(options.tets);
  auto const m = build_model(the_case, report);
  if (!the_case.mesh.file.empty()) std::filesystem::remove(the_case.mesh.file);
  auto s = step::make_state(m);
  scene.prepare(m, s);
  auto w = step::make_scratch(m, s);
  Monitor monitor(m);
  Guards const guards(m);
  step::EnergyBalance energy;
  using clock = std::chrono::steady_clock;
  clock::duration guarding{}; // the guards' own time: too short to be seen in the whole
  auto one = [&] {
    bool const reading = s.step % m.source.run.energy_every == 0;
    step::advance(m, s, w, reading ? &energy : nullptr);
    auto const before = clock::now();
    guards.after_step(m, s);
    guarding += clock::now() - before;
    if (reading) monitor.take(energy, m, s);
  };
  for (int i = 0; i < 5; ++i) one();
  long const steps = options.steps > 0
                         ? options.steps
                         : std::max(50L, static_cast<long>(2e7 * threads.count() / m.tet_count()));
  guarding = {};
  auto const start = clock::now();
  for (long i = 0; i < steps; ++i) one();
  double const seconds = std::chrono::duration<double>(clock::now() - start).count();
  double const each = seconds / (static_cast<double>(steps) * m.tet_count());
  return fmt::format("{}: {} tets, {} joints{}, {} threads, kernels {}, {} steps: {:.2f} ns per "
                     "tet-step ({:.2f} million per second), guards {:.3f} % of it\n",
                     scene.what, m.tet_count(), m.joint_count(), what_joints(concrete::count_joints(m, s)),
                     threads.count(), concrete::kernels().name, steps, each * 1e9, 1e-6 / each,
                     100 * std::chrono::duration<double>(guarding).count() / seconds);
}

} // namespace fissura::sim
