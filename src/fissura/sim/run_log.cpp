#include "fissura/sim/run_log.hpp"

#include <cmath>
#include <fmt/core.h>

#include "fissura/concrete/kernels.hpp"
#include "fissura/sim/hindsight.hpp"
#include "fissura/sim/log.hpp"
#include "fissura/sim/progress.hpp"

namespace fissura::sim {

using model::Model;
using state::State;

namespace {

bool is_paced(Model const& m) {
  return m.source.run.pace > 1;
}

} // namespace

void log_opening(Log& log, Model const& m, BuildReport const& report, std::string const& version) {
  auto const& c = m.source;
  log.info("fissura {}: {}", version, c.title.empty() ? "untitled case" : c.title);
  log.info("mesh: {} tets, {} joints; mean size {:.4g} mm, smallest altitude {:.4g} mm", m.tet_count(),
           m.joint_count(), report.quality.mean_h * 1e3, report.quality.smallest_altitude * 1e3);
  if (!m.bars.elements.empty())
    log.info("bars: {} elements, {} joints, {:.4g} m, {:.4g} kg of steel", m.bars.elements.size(),
             m.bars.joints.size(), report.embedding.length(), report.embedding.steel_mass());
  if (m.added_mass > 0) log.info("mass scaling adds {:.4g} kg to {:.4g} kg", m.added_mass, m.total_mass);
  for (auto const& note : report.notes) log.info("{}", note);
  for (auto const& warning : report.warnings) log.warning("{}", warning);
}

void log_restart(Log& log, State const& s, std::string const& checkpoint,
                 std::vector<std::string> const& changes, std::vector<std::string> const& warnings) {
  log.info("goes on from {} at t = {:.5g} s, step {}", checkpoint, s.time, s.step);
  for (auto const& change : changes) log.info("changed since: {}", change);
  for (auto const& warning : warnings) log.warning("{}", warning);
}

void log_steps_ahead(Log& log, Model const& m, double end, int threads) {
  log.info("time step {:.4g} s, limited by {}; {}{:.0f} steps to t = {:.4g} s; {} thread{}, kernels {}", m.dt,
           m.dt_limiter, is_paced(m) ? "at most " : "", std::ceil(end / m.dt), end, threads,
           threads == 1 ? "" : "s", concrete::kernels().name);
}

void log_end(Log& log, State const& s, RunResult const& result, double wall) {
  auto const level = result.status == "failed" ? Log::Level::error : Log::Level::info;
  log.log(level, "{}: {} (t = {:.5g} s, {} steps, {})", result.status, result.reason, s.time, s.step,
          readable_duration(wall));
}

void log_verdict(Log& log, Model const& m, State const& s, Monitor const& monitor) {
  auto const inertia = monitor.inertia();
  log.info("energy residual {:+.3g} % of the energy put in", 100 * monitor.residual());
  log.info("kinetic/internal energy below 5 % in {:.0f} % of the time (largest {:.3g}), forces out "
           "of balance by {:.2g} %{}: {}",
           100 * inertia.quiet_share, monitor.kinetic_ratio(), 100 * inertia.imbalance,
           inertia.period > 0
               ? fmt::format(" (vibrations of up to {:.3g} ms smoothed away)", 1e3 * inertia.period)
               : "",
           inertia.is_quasi_static() ? "quasi-static"
           : is_paced(m)             ? "inertia matters (else lower `pace_kinetic`, or load more slowly)"
                                     : "inertia matters (expected in dynamic cases; else load more slowly)");
  if (monitor.crossed_warning())
    log.warning("the energy residual passed {:.2g} %: look at the energy columns of history.csv before "
                "trusting the run",
                100 * m.source.run.residual_warn);
  for (auto const& doubt : steel_beyond_yield(m, s)) log.warning("{}", doubt);
}

} // namespace fissura::sim
