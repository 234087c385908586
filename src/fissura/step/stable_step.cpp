#include "fissura/step/stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

#include "fissura/rebar/rebar.hpp"

namespace fissura::step {

using model::Model;

namespace {

/// Largest eigenvalue of a symmetric 3x3 matrix, closed form.
double largest_eigenvalue(Mat3 const& a) {
  double const q = trace(a) / 3;
  Mat3 const d = a - q * Mat3::identity();
  double const p = std::sqrt(contract(d, d) / 6);
  if (p <= 0) return q;
  double const r = std::clamp(0.5 * determinant((1 / p) * d), -1.0, 1.0);
  return q + 2 * p * std::cos(std::acos(r) / 3);
}

/// Largest eigenvalue of sum_a g_a g_a^T, g_a the reference gradients of the four shape functions [1/m2].
double gradient_norm(Model const& m, std::size_t tet) {
  Mat3 sum;
  Vec3 last;
  auto add = [&](Vec3 g) { sum = sum + Mat3{{g.x * g, g.y * g, g.z * g}}; };
  for (int i = 0; i < 3; ++i) {
    Vec3 g;
    for (int r = 0; r < 3; ++r) g[r] = m.tets.gradient[model::at(tet, 3 * i + r, 9)];
    add(g);
    last -= g;
  }
  add(last);
  return largest_eigenvalue(sum);
}

/// Stiffness that joints put on each node: sum of p A/(3 h).
std::vector<double> joint_stiffness(Model const& m) {
  std::vector<double> k(4 * static_cast<std::size_t>(m.tets.count), 0);
  for (int i = 0; i < m.joints.count; ++i) {
    auto const& j = m.joints.joints[i];
    double const share = m.joints.law[i].k * j.area / 3;
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
  double dt() const {
    double const omega = std::sqrt(own + joints + bars), xi = viscous / (2 * omega);
    return 2 / omega * (std::sqrt(1 + xi * xi) - xi); // viscous forces lag half a step
  }
};

/// The bounds of all tets.
class Bounds {
 public:
  explicit Bounds(Model const& m) : m_(m), joint_k_(joint_stiffness(m)), bar_k_(joint_k_.size(), 0) {
    rebar::add_bar_stiffness(m.bars, bar_k_);
    sum_over_clusters(m, joint_k_);
    sum_over_clusters(m, bar_k_);
  }

  TetBound of(int tet) const {
    auto const t = static_cast<std::size_t>(tet);
    double const G = m_.tets.shear_modulus[t], lambda = m_.tets.lame[t], norm = gradient_norm(m_, t);
    TetBound b;
    for (std::size_t a = 0; a < 4; ++a) {
      double const inverse = m_.tets.inverse_mass[model::at(t, static_cast<int>(a), 4)],
                   own_mass = m_.mass[4 * t + a];
      // a bonded node's frequency is at most that of its stiffest tet alone (Rayleigh), so the own mass
      // counts
      b.own = std::max(b.own, m_.tets.volume[t] * (2 * G + 3 * lambda) * norm / own_mass);
      b.viscous = std::max(b.viscous, m_.tets.volume[t] * m_.tets.viscosity[t] * norm / own_mass);
      b.joints = std::max(b.joints, 2 * inverse * joint_k_[4 * t + a]);
      b.bars = std::max(b.bars, 2 * inverse * bar_k_[4 * t + a]);
    }
    return b;
  }

 private:
  Model const& m_;
  std::vector<double> joint_k_, bar_k_;
};

std::string describe(Model const& m, int tet, TetBound const& b) {
  char const* const lead = b.bars > b.joints && b.bars > b.own ? "bar joint"
                           : b.joints > b.own                  ? "joint"
                                                               : "tet";
  auto const c = mesh::corners(m.mesh, tet);
  Vec3 const at = 0.25 * (c[0] + c[1] + c[2] + c[3]);
  return fmt::format("{} at tet {} ({:.4g}, {:.4g}, {:.4g}) m", lead, m.mesh.input_id[tet], at.x, at.y, at.z);
}

} // namespace

StableStep stable_step(Model const& m) {
  Bounds const bounds(m);
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

std::vector<double> mass_factors(Model const& m, double dt) {
  Bounds const bounds(m);
  std::vector<double> factor(static_cast<std::size_t>(m.tets.count), 1);
  for (int tet = 0; tet < m.tets.count; ++tet) {
    double const own = bounds.of(tet).dt();
    if (own < dt) factor[static_cast<std::size_t>(tet)] = (dt / own) * (dt / own);
  }
  return factor;
}

} // namespace fissura::step
