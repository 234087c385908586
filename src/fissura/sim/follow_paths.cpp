#include "fissura/sim/follow_paths.hpp"

#include <fmt/core.h>

#include "fissura/loads/path.hpp"
#include "fissura/sim/log.hpp"

namespace fissura::sim {

namespace {

std::string describe_target(model::Model const& m, model::MotionPath const& path, int k,
                            Gauges const& gauges) {
  auto const& target = path.targets[static_cast<std::size_t>(k)];
  auto const gauge = static_cast<std::size_t>(target.gauge);
  return fmt::format("path of `{}`: target {} of {} reached, {} = {:.6g} for {:.6g}", path.name, k + 1,
                     path.targets.size(), m.source.gauges[gauge].name, gauges.values()[gauge], target.value);
}

} // namespace

std::optional<std::string> follow_paths(model::Model const& m, state::State& s, Gauges const& gauges,
                                        Log& log) {
  for (std::size_t i = 0; i < m.paths.size(); ++i) {
    auto const& path = m.paths[i];
    auto& at = s.paths[i];
    if (path.stage > s.stage || loads::path_ended(path, at)) continue;
    int const reached = loads::follow_path(path, at, s.load_time(), gauges.values());
    for (int k = at.target - reached; k < at.target; ++k)
      log.info("t = {:.5g} s: {}", s.time, describe_target(m, path, k, gauges));
    if (path.stops && loads::path_ended(path, at)) return describe_target(m, path, at.target - 1, gauges);
  }
  return std::nullopt;
}

} // namespace fissura::sim
