#include "fissura/step/stable_step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <vector>

#include "fissura/rebar/rebar.hpp"
#include "fissura/step/highest_frequency.hpp"
#include "fissura/step/tet_bound.hpp"

namespace fissura::step {

using model::Model;

double largest_step(double omega, double c) {
  double const xi = c / (2 * omega);
  return 2 / omega * (std::sqrt(1 + xi * xi) - xi);
}

namespace {

/// Stiffness that joints put on each node: sum of p A/(3 h).
std::vector<double> joint_stiffness(Model const& m) {
  std::vector<double> k(4 * static_cast<std::size_t>(m.tets.count), 0);
  for (int i = 0; i < m.joints.count; ++i) {
    auto const& j = m.joints.joints[i];
    double const share = m.joints.k(static_cast<std::size_t>(i)) * j.area / 3;
    for (int c = 0; c < 3; ++c) {
      k[j.node_a[c]] += share;
      k[j.node_b[c]] += share;
    }
  }
  return k;
}

/// Nodes that move as one share their sum.
void sum_over_clusters(Model const& m, std::vector<double>& stiffness) {
  if (!m.bonding.any) return;
  for (std::size_t c = 0; c + 1 < m.bonding.start.size(); ++c) {
    double sum = 0;
    for (int i = m.bonding.start[c]; i < m.bonding.start[c + 1]; ++i) sum += stiffness[m.bonding.node[i]];
    for (int i = m.bonding.start[c]; i < m.bonding.start[c + 1]; ++i) stiffness[m.bonding.node[i]] = sum;
  }
}

/// Frequency bound and damping ratio of one tet with its joints and bars.
struct TetBound {
  double own = 0, joints = 0, bars = 0; ///< omega^2 [1/s2]
  double viscous = 0;                   ///< c, the largest eigenvalue of the viscous matrix over mass [1/s]
  double dt() const { return largest_step(std::sqrt(own + joints + bars), viscous); }
};

/// How the mass of bonded nodes is shared out among their tets. Any sharing gives a safe bound (Rayleigh):
/// the tets alone are never slower than the body. `own`: each tet keeps its own mass. `by_stiffness`: each
/// gets mass in proportion to the stiffness V (2G + lambda) |grad N|^2 it puts on the node; closer where
/// small tets meet large ones. Nodes of their own know only `own`.
enum class MassSharing { own, by_stiffness };

std::vector<double> nodal_stiffness(Model const& m) {
  std::vector<double> k(4 * static_cast<std::size_t>(m.tets.count));
  for (std::size_t t = 0; 4 * t < k.size(); ++t) {
    auto const g = shape_gradients(m, t);
    for (std::size_t a = 0; a < 4; ++a)
      k[4 * t + a] = m.tets.volume[t] * (2 * m.tets.shear_modulus(t) + m.tets.lame(t)) * dot(g[a], g[a]);
  }
  return k;
}

std::vector<double> shared_masses(Model const& m, MassSharing sharing) {
  std::vector<double> mass(m.mass.begin(), m.mass.begin() + 4 * static_cast<std::ptrdiff_t>(m.tets.count));
  if (sharing == MassSharing::own || !m.bonding.any) return mass;
  auto const own = nodal_stiffness(m);
  auto total = own;
  sum_over_clusters(m, total);
  sum_over_clusters(m, mass);
  for (std::size_t n = 0; n < mass.size(); ++n) mass[n] *= own[n] / total[n];
  return mass;
}

/// The bounds of all tets.
class Bounds {
 public:
  Bounds(Model const& m, MassSharing sharing)
      : m_(m), mass_(shared_masses(m, sharing)), joint_k_(joint_stiffness(m)), bar_k_(joint_k_.size(), 0) {
    rebar::add_bar_stiffness(m.bars, bar_k_);
    sum_over_clusters(m, joint_k_);
    sum_over_clusters(m, bar_k_);
  }

  TetBound of(int tet) const {
    auto const t = static_cast<std::size_t>(tet);
    std::array<double, 4> const mass{mass_[4 * t], mass_[4 * t + 1], mass_[4 * t + 2], mass_[4 * t + 3]};
    TetBound b;
    b.own = elastic_bound(m_, t, mass);
    b.viscous = viscous_bound(m_, t, mass);
    for (std::size_t a = 0; a < 4; ++a) {
      double const inverse = m_.tets.inverse_mass[model::at(t, static_cast<int>(a), 4)];
      b.joints = std::max(b.joints, 2 * inverse * joint_k_[4 * t + a]);
      b.bars = std::max(b.bars, 2 * inverse * bar_k_[4 * t + a]);
    }
    return b;
  }

 private:
  Model const& m_;
  std::vector<double> mass_, joint_k_, bar_k_;
};

std::string describe(Model const& m, int tet, TetBound const& b) {
  char const* const lead = b.bars > b.joints && b.bars > b.own ? "bar joint"
                           : b.joints > b.own                  ? "joint"
                                                               : "tet";
  auto const c = mesh::corners(m.mesh, tet);
  Vec3 const at = 0.25 * (c[0] + c[1] + c[2] + c[3]);
  return fmt::format("{} at tet {} ({:.4g}, {:.4g}, {:.4g}) m", lead, m.mesh.input_id[tet], at.x, at.y, at.z);
}

StableStep slowest(Model const& m, MassSharing sharing) {
  Bounds const bounds(m, sharing);
  StableStep best;
  for (int tet = 0; tet < m.tets.count; ++tet) {
    double const dt = bounds.of(tet).dt();
    if (best.tet >= 0 && dt >= best.dt) continue;
    best.dt = dt;
    best.tet = tet;
  }
  auto const governing = bounds.of(best.tet);
  best.omega = std::sqrt(governing.own + governing.joints + governing.bars);
  best.limiter = describe(m, best.tet, governing);
  return best;
}

StableStep bound(Model const& m) {
  auto const own = slowest(m, MassSharing::own);
  if (!m.bonding.any) return own;
  auto const shared = slowest(m, MassSharing::by_stiffness); // both are safe: take the better
  return shared.dt > own.dt ? shared : own;
}

} // namespace

StableStep stable_step(Model const& m) {
  auto step = bound(m);
  step.bound = step.dt;
  auto const highest = highest_frequency(m);
  double const omega = std::sqrt(highest.omega_2), dt = largest_step(omega, highest.viscous);
  if (dt > step.dt) step.dt = dt, step.omega = omega;
  return step;
}

std::vector<double> mass_factors(Model const& m, double dt) {
  Bounds const bounds(m, MassSharing::own);
  std::vector<double> factor(static_cast<std::size_t>(m.tets.count), 1);
  for (int tet = 0; tet < m.tets.count; ++tet) {
    double const own = bounds.of(tet).dt();
    if (own < dt) factor[static_cast<std::size_t>(tet)] = (dt / own) * (dt / own);
  }
  return factor;
}

} // namespace fissura::step
