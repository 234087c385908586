// What a caller may ask of a run, checked before anything is done.
#include <cmath>
#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/sim/run.hpp"

namespace fissura::sim {

namespace {

void check_seconds(char const* option, std::optional<double> seconds) {
  if (!seconds || (std::isfinite(*seconds) && *seconds >= 0)) return;
  throw core::Error(
      core::Failure::input,
      fmt::format("{} must be a time of 0 s or more, not {} s; without it there is no such limit", option,
                  *seconds));
}

} // namespace

void check_options(RunOptions const& o) {
  check_seconds("--until", o.until);
  check_seconds("--walltime", o.walltime);
  if (o.threads < -1 || o.threads > most_threads)
    throw core::Error(core::Failure::input,
                      fmt::format("--threads must be 0 (all) to {}, not {}", most_threads, o.threads));
}

} // namespace fissura::sim
