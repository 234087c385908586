#include "fissura/sim/check.hpp"

#include <chrono>
#include <cmath>
#include <fmt/core.h>

#include "fissura/parallel/parallel.hpp"
#include "fissura/sim/build_model.hpp"
#include "fissura/sim/fields.hpp"
#include "fissura/sim/gauges.hpp"
#include "fissura/sim/progress.hpp"
#include "fissura/sim/stops.hpp"
#include "fissura/step/advance.hpp"

namespace fissura::sim {

namespace {

/// Seconds per step, measured on the real problem for a fraction of a second.
double measured_step(model::Model const& m) {
  auto s = step::make_state(m);
  auto w = step::make_scratch(m, s);
  using clock = std::chrono::steady_clock;
  step::advance(m, s, w);
  auto const start = clock::now();
  int steps = 0;
  double seconds = 0;
  while (seconds < 0.3 && steps < 2000) {
    step::advance(m, s, w);
    ++steps;
    seconds = std::chrono::duration<double>(clock::now() - start).count();
  }
  return seconds / steps;
}

double end_time(model::Model const& m) {
  if (m.source.run.end_time > 0) return m.source.run.end_time;
  double sum = 0;
  for (auto const& s : m.stages) sum += s.duration;
  return sum;
}

} // namespace

std::string check_case(model::Case const& c, std::string const& frames_folder) {
  parallel::Threads const threads(c.run.threads);
  BuildReport report;
  auto const m = build_model(c, report);
  Gauges const gauges(m);
  Stops const stops(c, gauges);
  if (!frames_folder.empty()) FieldWriter(frames_folder).write(m, step::make_state(m));

  double const end = end_time(m), steps = std::ceil(end / m.dt);
  double const memory = m.tet_count() * 900.0 + m.joint_count() * 420.0;
  double const frames = c.output.frames_every > 0 ? end / c.output.frames_every : c.output.frames;
  double const disk = frames * m.tet_count() * 110.0;
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
  line("steps", fmt::format("{:.0f} to t = {:.4g} s", steps, end));
  line("wall time", fmt::format("about {} on {} threads (intact; cracking costs more)",
                                readable_duration(1.3 * steps * measured_step(m)), threads.count()));
  line("memory", fmt::format("about {:.0f} MB", memory / 1e6 + 40));
  line("disk", fmt::format("about {:.0f} MB in {:.0f} frames", disk / 1e6, frames));
  for (auto const& note : report.notes) line("note", note);
  for (auto const& warning : report.warnings) line("warning", warning);
  return text;
}

} // namespace fissura::sim
