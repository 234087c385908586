#include "fissura/sim/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/core.h>

#include "fissura/sim/bar_doubts.hpp"
#include "fissura/sim/coarse_loads.hpp"
#include "fissura/sim/held.hpp"
#include "fissura/sim/material_doubts.hpp"
#include "fissura/sim/stages.hpp"
#include "fissura/units/units.hpp"

namespace fissura::sim {

using model::Curve;
using model::Model;
using units::Dimension;

namespace {

/// Crossings of a wave that a load should take to come, those below which it is as good as a jump, and those
/// of a run that is about waves [-].
constexpr double calm_crossings = 10, few_crossings = 1, wave_problem = 20;

class Doubts {
 public:
  Doubts(Model const& model, mesh::Quality const& quality) : m(model), q(quality) {}

  std::vector<std::string> all() {
    for (auto& text : material_doubts(m, q)) doubt(std::move(text));
    for (auto& text : bar_doubts(m)) doubt(std::move(text));
    size();
    supports();
    loads();
    for (auto& text : coarse_loads(m)) doubt(std::move(text));
    damping();
    duration();
    guards();
    return std::move(found);
  }

 private:
  void doubt(std::string text) { found.push_back(std::move(text)); }

  // ---- the body

  double extent(int axis) const { return q.high[axis] - q.low[axis]; }
  double longest() const { return std::max({extent(0), extent(1), extent(2)}); }

  void size() {
    if (longest() <= 300 && longest() >= 0.01) return;
    doubt(fmt::format("the body is {:.4g} m x {:.4g} m x {:.4g} m: is the unit of length right? {}",
                      extent(0), extent(1), extent(2),
                      m.source.mesh.file.empty() ? "See `from` and `to` of [[mesh.box]]"
                                                 : "A mesh drawn in millimetres needs length_unit = \"mm\""));
  }

  // ---- supports

  /// A body that is meant to move: thrown, dropped, struck, open to waves, or looked at for a few crossings
  /// of a wave, in which it goes nowhere.
  bool may_move() const {
    return is_thrown() || (m.prescribed.empty() && !m.source.impactors.empty()) ||
           end_time() < wave_problem * crossing();
  }
  bool is_thrown() const {
    auto const& c = m.source;
    return !c.initial_velocities.empty() || !c.planes.empty() || !c.absorbing.empty();
  }

  void supports() {
    if (is_thrown()) return;
    for (auto& text : held_doubts(m, may_move())) doubt(std::move(text));
  }

  // ---- loads

  /// Speed of compression waves in the stiffest concrete [m/s].
  double wave_speed() const {
    double c = 0;
    for (auto const& material : m.source.concretes)
      c = std::max(c, std::sqrt(material.E / (material.density * material.density_factor)));
    return c;
  }
  double crossing() const { return longest() / wave_speed(); }

  void loads() {
    auto const& c = m.source;
    bool const any =
        !c.motions.empty() || !c.forces.empty() || !c.tractions.empty() || c.gravity.on ||
        !c.impactors.empty() || !c.initial_velocities.empty() ||
        std::any_of(c.bars.begin(), c.bars.end(), [](auto const& b) { return b.initial_strain != 0; });
    if (!any) doubt("nothing loads the body: add a [[motion]], [[force]], [[traction]] or [gravity]");
    for (auto const& motion : c.motions)
      if (!motion.path && !motion.record) check_motion(motion);
    for (auto const& f : c.forces) check_jump(f.name, "force", f.curve, Dimension::force);
    for (auto const& t : c.tractions) check_jump(t.name, "traction", t.curve, Dimension::pressure);
  }

  std::string ramp(char const* key, double value, Dimension dimension) const {
    return fmt::format("{} = {{value = \"{}\", over = \"{:.2g} ms\"}}", key, units::from_si(value, dimension),
                       std::max(0.01, 1e3 * calm_crossings * crossing()));
  }

  void check_motion(model::MotionSpec const& motion) {
    if (motion.is_velocity) check_jump(motion.name, "velocity", motion.curve, Dimension::velocity);
    auto const speed = largest_speed(motion);
    double const cracks = speed_that_cracks();
    if (!speed || cracks <= 0 || *speed <= cracks) return;
    doubt(fmt::format(
        "motion `{}` reaches {:.3g} m/s; {:.2g} m/s already send a wave that cracks the concrete (f_t "
        "c/E): right for an impact, otherwise load more slowly",
        motion.name, *speed, cracks));
  }

  /// A load that is there at once, or before a wave has crossed the body.
  void check_jump(std::string const& name, char const* key, Curve const& curve, Dimension dimension) {
    bool const at_once = curve.kind == Curve::Kind::constant && curve.value != 0;
    bool const soon = curve.kind == Curve::Kind::ramp && curve.over < few_crossings * crossing();
    bool const table_starts = curve.kind == Curve::Kind::table && curve.values.front() != 0;
    if (at_once || soon || table_starts)
      doubt(fmt::format(
          "`{}` comes as a jump, which may break the concrete where it acts; let it grow, e.g. {}", name,
          table_starts ? "from 0 in the first row of its table" : ramp(key, curve.value, dimension)));
  }

  static std::optional<double> largest_speed(model::MotionSpec const& motion) {
    auto const& c = motion.curve;
    if (motion.is_velocity && (c.kind == Curve::Kind::constant || c.kind == Curve::Kind::ramp))
      return std::abs(c.value);
    if (!motion.is_velocity && c.kind == Curve::Kind::ramp) return 1.875 * std::abs(c.value) / c.over;
    if (c.kind == Curve::Kind::table) return motion.is_velocity ? largest_value(c) : steepest(c);
    return std::nullopt;
  }

  static double largest_value(Curve const& table) {
    double most = 0;
    for (double const v : table.values) most = std::max(most, std::abs(v));
    return most;
  }
  /// Between two rows: straight, or a cubic whose slopes at the rows are given and nearly the largest.
  static double steepest(Curve const& table) {
    double most = 0;
    for (std::size_t i = 1; i < table.times.size(); ++i)
      most = std::max(most, std::abs(table.values[i] - table.values[i - 1]) /
                                (table.times[i] - table.times[i - 1]));
    for (double const slope : table.slopes) most = std::max(most, std::abs(slope));
    return most;
  }

  /// v = c f_t/E of the weakest concrete that may crack [m/s]; 0 if none may.
  double speed_that_cracks() const {
    double least = 0;
    for (auto const& c : m.source.concretes) {
      if (!c.joints || !c.crackable) continue;
      double const v = c.f_t / std::sqrt(c.E * c.density);
      least = least == 0 ? v : std::min(least, v);
    }
    return least;
  }

  // ---- the run

  /// Twice the frequency of the slowest wave along the body: above it nothing swings.
  void damping() {
    double const critical = std::numbers::pi / crossing();
    for (auto const& s : m.stages)
      if (s.mass_damping > critical) {
        doubt(fmt::format(
            "`mass_damping` = {:.3g} 1/s: above {:.3g} 1/s the drag outweighs inertia in every motion of "
            "this body and carries part of the load; some per cent of it are enough",
            s.mass_damping, critical));
        return;
      }
  }

  double end_time() const { return planned_end(m); }

  void duration() {
    double const end = end_time();
    if (end < crossing())
      doubt(fmt::format("the run ends at {}, before a wave has crossed the body ({:.2g} ms): is the unit of "
                        "`end_time` right?",
                        units::from_si(end, Dimension::time), 1e3 * crossing()));
    if (end / m.dt < 20)
      doubt(fmt::format("the run has {:.2g} time steps of {:.3g} s to {}: too few to follow any motion; are "
                        "`end_time`, `least_dt`, `density` and `E` right?",
                        end / m.dt, m.dt, units::from_si(end, Dimension::time)));
    if (end / m.dt > 1e9)
      doubt(fmt::format(
          "the run takes {:.2g} steps to {}: this is an explicit program, load within a fraction of a "
          "second; is the unit of `end_time` right?",
          end / m.dt, units::from_si(end, Dimension::time)));
  }

  void guards() {
    auto const& run = m.source.run;
    if (run.residual_stop > 0.5)
      doubt(fmt::format(
          "[run] residual_stop = {:.3g}: with it nothing stops a run that creates or loses {:.3g} % "
          "of its energy; 0.05 is usual",
          run.residual_stop, 100 * run.residual_stop));
    for (auto const& s : m.stages)
      if (s.local_damping > 0.9) {
        doubt(fmt::format(
            "`local_damping` = {:.3g} takes nearly all force that moves the body: it creeps; 0.1 to "
            "0.8 are usual",
            s.local_damping));
        return;
      }
  }

  Model const& m;
  mesh::Quality const& q;
  std::vector<std::string> found;
};

} // namespace

std::vector<std::string> doubts(Model const& m, mesh::Quality const& quality) {
  return Doubts(m, quality).all();
}

} // namespace fissura::sim
