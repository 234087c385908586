#include "fissura/sim/crack_delay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fissura/loads/curve.hpp"
#include "fissura/model/make_blocks.hpp"
#include "fissura/step/joint_inertia.hpp"

namespace fissura::sim {

using model::ConcreteSpec;
using model::Model;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double largest_extent(Model const& m) {
  Vec3 low{infinite, infinite, infinite}, high{-infinite, -infinite, -infinite};
  for (auto const& x : m.mesh.points)
    for (int r = 0; r < 3; ++r) low[r] = std::min(low[r], x[r]), high[r] = std::max(high[r], x[r]);
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

/// Over the concretes that crack: the smallest strain at f_t, and the largest G_f/f_t^2.
struct Weakest {
  double strain = infinite, G_f_per_f_t_2 = 0;
};
Weakest weakest(Model const& m) {
  Weakest w;
  for (ConcreteSpec const& c : m.source.concretes) {
    if (!c.joints || !c.crackable || c.f_t <= 0) continue;
    double const G_f = c.G_f > 0 ? c.G_f : model::default_fracture_energy(c.f_c);
    w.strain = std::min(w.strain, c.f_t / c.E);
    w.G_f_per_f_t_2 = std::max(w.G_f_per_f_t_2, G_f / (c.f_t * c.f_t));
  }
  return w;
}

/// The time in which a motion moves on by `far`, at the speed it has when it has come so far. The end of the
/// run has no say: a run that is prolonged must stay what it was.
double rise_of(Model const& m, model::Prescribed const& p, double far) {
  if (p.path >= 0) return far / std::abs(p.scale * m.paths[static_cast<std::size_t>(p.path)].speed);
  auto const& curve = p.motion.curve;
  double const length = loads::length_of(curve), last = std::abs(loads::value_at(curve, length));
  constexpr int samples = 4000;
  double moved = 0, before = 0, at = 0;
  for (int i = 1; i <= samples && length > 0; ++i) {
    double const share = static_cast<double>(i) / samples,
                 now = length * share * share; // dense at the beginning
    double const value = loads::value_at(curve, now);
    double const next = p.is_velocity ? moved + 0.5 * (value + before) * (now - at) : value;
    if (std::abs(next) >= far) return far * (now - at) / std::abs(next - moved);
    moved = next, before = value, at = now;
  }
  if (p.is_velocity) return last > 0 ? far / last : infinite; // goes on as the curve ended
  return last >= far ? 0 : infinite;                          // a jump
}

/// A ground motion carries the whole body along: what strains it is its own vibration, which is slow.
bool is_ground(Model const& m, model::Prescribed const& p) {
  return std::any_of(m.source.motions.begin(), m.source.motions.end(),
                     [&](model::MotionSpec const& s) { return s.record && s.name == p.name; });
}

/// Forces crack a body, if at all, at some tenth of what they grow to.
double rise_of(model::AppliedForce const& f) {
  return 0.1 * loads::length_of(f.curve.curve);
}

} // namespace

CrackDelay crack_delay(Model const& m, double rate) {
  auto const weak = weakest(m);
  double area = 0, inertia = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(m.joints.count); ++j) {
    double const a = m.joints.joints[j].area;
    area += a, inertia += a * step::inertia_of_joint(m, j, rate);
  }
  CrackDelay d{infinite, 0};
  if (weak.strain == infinite || area == 0) return d;
  // Two ends that are pulled apart share the way.
  double const far = 0.5 * weak.strain * largest_extent(m);
  for (auto const& p : m.prescribed)
    if (!is_ground(m, p)) d.rise = std::min(d.rise, rise_of(m, p, far));
  for (auto const& f : m.forces) d.rise = std::min(d.rise, rise_of(f));
  d.share = std::cbrt(6 * inertia / area * weak.G_f_per_f_t_2 / (d.rise * d.rise));
  return d;
}

} // namespace fissura::sim
