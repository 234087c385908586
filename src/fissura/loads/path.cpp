#include "fissura/loads/path.hpp"

#include <algorithm>

#include "fissura/loads/curve.hpp"

namespace fissura::loads {

using model::MotionPath;
using state::PathState;

namespace {

struct Motion {
  double velocity, acceleration;
};

/// x (1 - x)^3 (1 + 3 x): slope 1 and no curvature at 0, at 1 neither value, slope nor curvature.
double fading_slope(double x) {
  double const rest = 1 - x;
  return x * rest * rest * rest * (1 + 3 * x);
}
double fading_slope_rate(double x) {
  double const rest = 1 - x;
  return rest * rest * (1 + x * (2 - 15 * x));
}

/// v = v_0 + (v_1 - v_0) S(x) + a_0 T R(x), S the smooth step, R the fading slope, x = (t - t_0)/T.
Motion motion_at(MotionPath const& path, PathState const& s, double t) {
  double const x = std::clamp((t - s.turned_at) / path.turn, 0.0, 1.0), rest = x * (1 - x);
  double const change = s.toward - s.velocity;
  return {s.velocity + change * smooth_step(x) + s.acceleration * path.turn * fading_slope(x),
          change * 30 * rest * rest / path.turn + s.acceleration * fading_slope_rate(x)};
}

bool reached(MotionPath const& path, PathState const& s, std::vector<double> const& readings) {
  auto const& target = path.targets[static_cast<std::size_t>(s.target)];
  double const now = readings[static_cast<std::size_t>(target.gauge)];
  return s.rising ? now >= target.value : now <= target.value;
}

/// Turns towards the next target; to rest after the last one.
void next_leg(MotionPath const& path, PathState& s, double t, std::vector<double> const& readings) {
  Motion const now = motion_at(path, s, t);
  ++s.target;
  double toward = 0;
  if (!path_ended(path, s)) {
    auto const& target = path.targets[static_cast<std::size_t>(s.target)];
    s.rising = readings[static_cast<std::size_t>(target.gauge)] < target.value;
    toward = s.rising ? path.speed : -path.speed;
  }
  if (toward == s.toward) return; // goes on as it does
  s.turned_at = t;
  s.velocity = now.velocity;
  s.acceleration = now.acceleration;
  s.toward = toward;
}

} // namespace

double path_velocity(MotionPath const& path, PathState const& s, double t) {
  return motion_at(path, s, t).velocity;
}

bool path_ended(MotionPath const& path, PathState const& s) {
  return s.target >= static_cast<int>(path.targets.size());
}

int follow_path(MotionPath const& path, PathState& s, double t, std::vector<double> const& readings) {
  if (s.target < 0) next_leg(path, s, t, readings);
  int count = 0;
  for (; !path_ended(path, s) && reached(path, s, readings); ++count) next_leg(path, s, t, readings);
  return count;
}

} // namespace fissura::loads
