#include "fissura/sim/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Eigenvalues>
#include <fmt/core.h>

#include "fissura/loads/curve.hpp"
#include "fissura/units/units.hpp"

namespace fissura::sim {

using model::Curve;
using model::Model;
using units::Dimension;

namespace {

/// What is usual of a quantity [SI]; outside of it a unit is likely wrong.
struct Usual {
  double least, most;
  Dimension dimension;
};
constexpr Usual concrete_E{5e9, 80e9, Dimension::pressure}, concrete_f_t{0.3e6, 15e6, Dimension::pressure},
    concrete_f_c{5e6, 250e6, Dimension::pressure}, concrete_G_f{5, 1000, Dimension::energy_per_area},
    density{300, 12000, Dimension::density}, steel_E{50e9, 250e9, Dimension::pressure},
    steel_f_y{100e6, 2500e6, Dimension::pressure}, diameter{1e-3, 0.06, Dimension::length};

/// Crossings of a wave that a load should take to come, those below which it is as good as a jump, and those
/// of a run that is about waves [-].
constexpr double calm_crossings = 10, few_crossings = 1, wave_problem = 20;

class Doubts {
 public:
  Doubts(Model const& model, mesh::Quality const& quality) : m(model), q(quality) {}

  std::vector<std::string> all() {
    materials();
    size();
    supports();
    loads();
    damping();
    duration();
    return std::move(found);
  }

 private:
  void doubt(std::string text) { found.push_back(std::move(text)); }

  // ---- materials

  void check(std::string const& of, char const* key, double value, Usual const& usual) {
    if (value <= 0 || (value >= usual.least && value <= usual.most)) return;
    doubt(fmt::format("{}: `{}` = {} lies outside the usual {} to {}: is the unit right?", of, key,
                      units::from_si(value, usual.dimension), units::from_si(usual.least, usual.dimension),
                      units::from_si(usual.most, usual.dimension)));
  }

  void materials() {
    for (auto const& c : m.source.concretes) {
      if (!c.joints || !c.crackable) continue; // plates of steel, lumped masses
      check(c.name, "density", c.density, density);
      check(c.name, "E", c.E, concrete_E);
      check(c.name, "f_t", c.f_t, concrete_f_t);
      check(c.name, "f_c", c.f_c, concrete_f_c);
      check(c.name, "G_f", c.G_f, concrete_G_f);
    }
    for (auto const& s : m.source.steels) {
      check(s.name, "E_s", s.E_s, steel_E);
      check(s.name, "f_y", s.f_y, steel_f_y);
      check(s.name, "density", s.density, density);
    }
    for (auto const& b : m.source.bars)
      if (b.area == 0) check(b.name, "diameter", b.diameter, diameter); // a lumped bar gives its area
  }

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
    auto const& c = m.source;
    bool const thrown = !c.initial_velocities.empty() || !c.planes.empty() || !c.absorbing.empty();
    return thrown || (m.prescribed.empty() && !c.impactors.empty()) || end_time() < wave_problem * crossing();
  }

  void supports() {
    auto const bodies = mesh::connected_bodies(m.mesh, m.adjacency);
    bool const one = bodies.empty() || *std::max_element(bodies.begin(), bodies.end()) == 0;
    if (!one || may_move()) return;
    auto const free = free_motions();
    for (int k = 0; k < 3; ++k)
      if (free.moves[static_cast<std::size_t>(k)])
        doubt(fmt::format(
            "nothing holds the body along {0}: any force there carries it off; add a [[support]] with "
            "fix = [\"{0}\"]",
            "xyz"[k]));
    if (free.turns >= 0)
      doubt(fmt::format(
          "nothing keeps the body from turning about an axis along {}: add a [[support]] away from that "
          "axis",
          "xyz"[free.turns]));
  }

  struct FreeMotions {
    std::array<bool, 3> moves{};
    int turns = -1; ///< axis of a free rotation, or -1
  };

  /// Rigid motions that no support and no prescribed motion concerns: the null space of their sum of squares.
  FreeMotions free_motions() const {
    Vec3 const centre = 0.5 * (q.low + q.high);
    Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
    for (auto const& p : m.prescribed) {
      Eigen::Matrix<double, 6, 6> mine = Eigen::Matrix<double, 6, 6>::Zero();
      for (int const node : p.nodes) {
        Vec3 const x = (2 / longest()) * (m.position.at(static_cast<std::size_t>(node)) - centre);
        Eigen::Matrix<double, 6, 1> row = Eigen::Matrix<double, 6, 1>::Zero();
        row[p.axis] =
            1; // displacement along the axis of a unit translation, and of unit rotations: (w x r).e
        int const next = (p.axis + 1) % 3, last = (p.axis + 2) % 3;
        row[3 + next] = x[last], row[3 + last] = -x[next];
        mine += row * row.transpose();
      }
      if (!p.nodes.empty()) sum += mine / static_cast<double>(p.nodes.size());
    }
    FreeMotions free;
    for (int k = 0; k < 3; ++k) free.moves[static_cast<std::size_t>(k)] = sum.row(k).norm() < 1e-9;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> const modes(sum);
    for (int i = 0; i < 6; ++i) {
      if (modes.eigenvalues()[i] > 1e-9) continue;
      Eigen::Vector3d turn = modes.eigenvectors().col(i).tail<3>();
      if (turn.norm() > 1e-3) turn.cwiseAbs().maxCoeff(&free.turns);
    }
    return free;
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

  double end_time() const {
    if (m.source.run.end_time > 0) return m.source.run.end_time;
    double sum = 0;
    for (auto const& s : m.stages) sum += s.duration;
    return sum;
  }

  void duration() {
    double const end = end_time();
    if (end < crossing())
      doubt(fmt::format("the run ends at {}, before a wave has crossed the body ({:.2g} ms): is the unit of "
                        "`end_time` right?",
                        units::from_si(end, Dimension::time), 1e3 * crossing()));
    if (end / m.dt > 1e9)
      doubt(fmt::format(
          "the run takes {:.2g} steps to {}: this is an explicit program, load within a fraction of a "
          "second; is the unit of `end_time` right?",
          end / m.dt, units::from_si(end, Dimension::time)));
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
