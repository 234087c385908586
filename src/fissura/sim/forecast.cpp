#include "fissura/sim/forecast.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include <sys/resource.h>

#include "fissura/sim/stages.hpp"
#include "fissura/step/advance.hpp"

namespace fissura::sim {

namespace {

constexpr double longest_look = 0.3; ///< [s]
constexpr double piece = 0.01;       ///< [s]: shorter than what the system gives a program in one go
constexpr int most_steps = 2000;

/// Bytes of a frame on the disk, compressed, measured on cracked bodies: fields per tet, bars per element.
constexpr double per_tet = 125, per_bar_element = 65;
/// While a frame is written it stands in memory, as arrays and as the file.
constexpr double frame_per_tet = 700, frame_per_bar_element = 500;
/// A checkpoint holds the state, bare; damaged joints add to it as they come.
constexpr double state_per_tet = 200, state_per_joint = 20, state_per_bar_joint = 490;

double peak_memory() {
  rusage use{};
  ::getrusage(RUSAGE_SELF, &use);
  return 1024.0 * static_cast<double>(use.ru_maxrss);
}

} // namespace

StepTime step_time(std::vector<double> const& seconds, int steps_each) {
  if (seconds.empty()) return {};
  double const sum = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  double const least = *std::min_element(seconds.begin(), seconds.end());
  return {least / steps_each, sum / steps_each / static_cast<double>(seconds.size())};
}

StepTime measure_step(model::Model const& m) {
  auto s = step::make_state(m);
  auto w = step::make_scratch(m, s);
  using clock = std::chrono::steady_clock;
  auto const timed = [&](int steps) {
    auto const start = clock::now();
    for (int i = 0; i < steps; ++i) step::advance(m, s, w);
    return std::chrono::duration<double>(clock::now() - start).count();
  };
  timed(1); // the first one finds nothing in the caches
  double const one = std::max(1e-7, timed(1));
  int const each = static_cast<int>(std::clamp(piece / one, 1.0, 100.0));
  std::vector<double> pieces;
  for (double sum = 0; sum < longest_look && static_cast<int>(pieces.size() + 1) * each <= most_steps;) {
    pieces.push_back(timed(each));
    sum += pieces.back();
  }
  return step_time(pieces, each);
}

Storage measure_storage(model::Model const& m) {
  auto const& out = m.source.output;
  double const end = planned_end(m), tets = m.tet_count(), bars = static_cast<double>(m.bars.elements.size());
  double const bar_joints = static_cast<double>(m.bars.joints.size());
  double const columns = 30 + static_cast<double>(m.source.gauges.size() + m.prescribed.size());
  double const rows = out.history_every > 0 ? end / out.history_every : out.history_points;
  Storage s;
  s.frames = out.frames_every > 0 ? end / out.frames_every : out.frames;
  s.checkpoint = state_per_tet * tets + state_per_joint * m.joint_count() + state_per_bar_joint * bar_joints;
  s.disk = s.frames * (per_tet * tets + per_bar_element * bars) + 12 * columns * rows;
  s.memory = peak_memory() + (s.frames > 0 ? frame_per_tet * tets + frame_per_bar_element * bars : 0) +
             8 * columns * rows;
  return s;
}

} // namespace fissura::sim
