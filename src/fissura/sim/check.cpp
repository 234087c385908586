#include "fissura/sim/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/core.h>
#include <thread>

#include "fissura/parallel/parallel.hpp"
#include "fissura/sim/build_model.hpp"
#include "fissura/sim/fields.hpp"
#include "fissura/sim/forecast.hpp"
#include "fissura/sim/gauges.hpp"
#include "fissura/sim/progress.hpp"
#include "fissura/sim/stages.hpp"
#include "fissura/sim/stops.hpp"
#include "fissura/step/advance.hpp"

namespace fissura::sim {

namespace {

/// A machine that takes so much longer has other work to do [-].
constexpr double busy = 1.3;

/// "about 12 s on 2 threads (intact; cracking costs more)", and what other programs make of it.
std::string wall_time(double steps, StepTime const& step, int threads) {
  constexpr double outputs = 1.3; // frames, history and readings beside the steps
  auto text =
      fmt::format("about {} on {} thread{} (intact; cracking costs more)",
                  readable_duration(outputs * steps * step.undisturbed), threads, threads == 1 ? "" : "s");
  if (step.now < busy * step.undisturbed || outputs * steps * step.now < 10) return text;
  double load[1] = {0};
  bool const known = ::getloadavg(load, 1) == 1;
  return text + fmt::format("; other programs are busy here{}: while they are, rather {}",
                            known ? fmt::format(" (load {:.1f} on {} processors)", load[0],
                                                std::thread::hardware_concurrency())
                                  : "",
                            readable_duration(outputs * steps * step.now));
}

std::string megabytes(double bytes) {
  return bytes < 10e6 ? fmt::format("{:.2g} MB", std::max(bytes, 1e4) / 1e6)
                      : fmt::format("{:.0f} MB", bytes / 1e6);
}

} // namespace

std::string check_case(model::Case const& c, std::string const& frames_folder) {
  parallel::Threads const threads(c.run.threads);
  BuildReport report;
  auto const m = build_model(c, report);
  Gauges const gauges(m);
  Stops const stops(c, gauges);
  if (!frames_folder.empty()) FieldWriter(frames_folder).write(m, step::make_state(m));

  double const end = planned_end(m), steps = std::ceil(end / m.dt);
  auto const step = measure_step(m);
  auto const storage = measure_storage(m);
  std::string text;
  auto line = [&](std::string const& name, std::string const& value) {
    text += fmt::format("{:<16}{}\n", name, value);
  };
  line("case", c.title.empty() ? c.deck_file : c.title);
  line("tets", fmt::format("{}", m.tet_count()));
  line("joints", fmt::format("{}", m.joint_count()));
  line("bar elements", fmt::format("{} with {} joints, {:.4g} kg of steel", m.bars.elements.size(),
                                   m.bars.joints.size(), report.embedding.steel_mass()));
  line("mass",
       fmt::format("{:.6g} kg{}", m.total_mass,
                   m.added_mass > 0 ? fmt::format(" + {:.4g} kg by mass scaling", m.added_mass) : ""));
  line("time step", fmt::format("{:.4g} s, limited by {}", m.dt, m.dt_limiter));
  line("steps", steps < 1e12 ? fmt::format("{:.0f} to t = {:.4g} s", steps, end)
                             : fmt::format("{:.3g} to t = {:.4g} s", steps, end));
  line("wall time", wall_time(steps, step, threads.count()));
  line("memory", fmt::format("about {}", megabytes(storage.memory)));
  line("disk", fmt::format("about {} in {:.0f} frames; {} for each of at most two checkpoints",
                           megabytes(storage.disk), storage.frames, megabytes(storage.checkpoint)));
  for (auto const& note : report.notes) line("note", note);
  for (auto const& warning : report.warnings) line("warning", warning);
  return text;
}

} // namespace fissura::sim
