#include "fissura/sim/advice.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>

namespace fissura::sim {

using model::Curve;
using model::Model;

namespace {

constexpr double fast_share = 0.25;    ///< kinetic over elastic energy at cracking that is surely too fast
constexpr double damping_share = 0.05; ///< of the force that cracks the smallest section
constexpr double transits = 10;        ///< of a wave through the body, in which a motion should begin
constexpr double slender = 3;          ///< length over height of what is taken for a beam
constexpr double cells_wanted = 8;

bool is_dynamic(model::Case const& c) {
  bool dynamic = !c.impactors.empty() || !c.initial_velocities.empty() || !c.absorbing.empty();
  for (auto const& motion : c.motions) dynamic |= motion.record.has_value();
  return dynamic;
}

/// Axes along which something pushes or pulls.
std::set<int> loaded_axes(model::Case const& c) {
  std::set<int> axes;
  auto const add = [&](Vec3 direction) {
    for (int k = 0; k < 3; ++k)
      if (std::abs(direction[k]) > 0.5) axes.insert(k);
  };
  for (auto const& motion : c.motions) axes.insert(motion.axis);
  for (auto const& force : c.forces) add(force.direction);
  for (auto const& traction : c.tractions)
    if (!traction.normal) add(traction.direction);
  if (c.gravity.on) add(c.gravity.direction);
  return axes;
}

void advise_height(std::vector<std::string>& out, Model const& m, mesh::Quality const& q) {
  Vec3 const extent = q.high - q.low;
  double const length = std::max({extent.x, extent.y, extent.z});
  if (m.source.supports.empty()) return;
  for (int const k : loaded_axes(m.source)) {
    auto const cells = q.elements_over[static_cast<std::size_t>(k)];
    if (length < slender * extent[k] || cells >= cells_wanted - 0.5 || cells < 3.5)
      continue; // below: said by the mesh
    out.push_back(fmt::format(
        "about {:.1f} elements over the height along {} ({:.4g} m) of a member that is bent: with {:.0f} "
        "or more its stiffness and crack pattern hardly change any more; use a finer mesh",
        cells, "xyz"[k], extent[k], cells_wanted));
  }
}

/// A motion of the deck as far as its speed is concerned.
struct Speed {
  double value = 0; ///< largest [m/s]
  double rise = 0;  ///< in which a velocity is reached [s]; infinite: not a velocity
};

Speed speed_of(model::MotionSpec const& motion) {
  double const never = std::numeric_limits<double>::infinity();
  if (motion.path)
    return {std::abs(motion.path->speed * (motion.path->of.empty() ? 1 : motion.path->scale)), never};
  Speed s{largest_speed(motion.curve, motion.is_velocity), never};
  if (motion.is_velocity && motion.curve.kind == Curve::Kind::constant) s.rise = 0;
  if (motion.is_velocity && motion.curve.kind == Curve::Kind::ramp) s.rise = motion.curve.over;
  return s;
}

void advise_speed(std::vector<std::string>& out, Model const& m, mesh::Quality const& q) {
  auto const& concrete = m.source.concretes.front();
  if (!(concrete.f_t > 0)) return;
  double const wave = std::sqrt(concrete.E / concrete.density), transit = norm(q.high - q.low) / wave;
  for (auto const& motion : m.source.motions) {
    auto const s = speed_of(motion);
    if (s.value <= 0) continue;
    double const share = speed_share(concrete, s.value), sound = s.value * std::sqrt(0.04 / share);
    if (share > fast_share)
      out.push_back(fmt::format("motion `{}` moves at {:.3g} m/s, which is fast for a slow test: its kinetic "
                                "energy is {:.0f} % of the "
                                "elastic energy at cracking; load at {:.2g} m/s or less",
                                motion.name, s.value, 100 * share, sound));
    // sigma = rho c v of a wave that starts with a jump
    double const jump = concrete.density * wave * s.value / concrete.f_t;
    if (s.rise < 0.5 * transits * transit && jump > 0.1)
      out.push_back(fmt::format(
          "motion `{}` reaches its velocity in {:.3g} ms, {:.1f} times what a wave needs through the body; a "
          "sudden start cracks the grip: let it rise over {:.2g} ms or more (velocity = {{value = ..., over "
          "= ...}})",
          motion.name, 1e3 * s.rise, s.rise / transit, 1e3 * transits * transit));
  }
}

/// Mass damping of the stage in which a motion acts [1/s].
double damping_of(Model const& m, std::string const& stage) {
  for (auto const& s : m.source.stages)
    if (s.name == stage && s.mass_damping >= 0) return s.mass_damping;
  return m.source.run.mass_damping;
}

void advise_damping(std::vector<std::string>& out, Model const& m, mesh::Quality const& q) {
  auto const& concrete = m.source.concretes.front();
  Vec3 const extent = q.high - q.low;
  double const section = q.volume / std::max({extent.x, extent.y, extent.z}),
               strength = concrete.f_t * section;
  if (!(strength > 0)) return;
  for (auto const& motion : m.source.motions) {
    double const c = damping_of(m, motion.stage), force = c * m.total_mass * speed_of(motion).value;
    if (force <= damping_share * strength) continue;
    out.push_back(fmt::format("mass damping of {:.4g} 1/s carries up to {:.3g} kN while motion `{}` moves "
                              "the body, {:.0f} % of what "
                              "cracks its mean section: take {:.2g} 1/s or less, or load more slowly",
                              c, 1e-3 * force, motion.name, 100 * force / strength,
                              0.5 * c * damping_share * strength / force));
    return; // once is enough
  }
}

} // namespace

double speed_share(model::ConcreteSpec const& concrete, double speed) {
  double const ratio = speed * std::sqrt(concrete.density * concrete.E) / concrete.f_t;
  return ratio * ratio;
}

double largest_speed(Curve const& curve, bool is_velocity) {
  auto const largest = [](std::vector<double> const& v) {
    double most = 0;
    for (double const x : v) most = std::max(most, std::abs(x));
    return most;
  };
  switch (curve.kind) {
  case Curve::Kind::constant:
    return is_velocity ? std::abs(curve.value) : 0;
  case Curve::Kind::ramp: // 1.875: the steepest slope of the smooth ramp, of its mean
    return is_velocity      ? std::abs(curve.value)
           : curve.over > 0 ? 1.875 * std::abs(curve.value) / curve.over
                            : 0;
  case Curve::Kind::table: {
    if (is_velocity) return largest(curve.values);
    double most = 0;
    for (std::size_t i = 1; i < curve.times.size(); ++i)
      most = std::max(
          most, std::abs((curve.values[i] - curve.values[i - 1]) / (curve.times[i] - curve.times[i - 1])));
    return most;
  }
  case Curve::Kind::cycles:
    return is_velocity        ? largest(curve.peaks)
           : curve.period > 0 ? 4 * largest(curve.peaks) / curve.period
                              : 0;
  }
  return 0;
}

std::vector<std::string> advice(Model const& m, mesh::Quality const& quality) {
  std::vector<std::string> out;
  if (m.source.concretes.empty()) return out;
  advise_height(out, m, quality);
  if (is_dynamic(m.source)) return out;
  advise_speed(out, m, quality);
  advise_damping(out, m, quality);
  return out;
}

} // namespace fissura::sim
