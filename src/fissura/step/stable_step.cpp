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

} // namespace

StableStep stable_step(Model const& m) {
  std::vector<double> joint_k = joint_stiffness(m), bar_k(joint_k.size(), 0);
  rebar::add_bar_stiffness(m.bars, bar_k);
  sum_over_clusters(m, joint_k);
  sum_over_clusters(m, bar_k);

  StableStep best;
  TetBound governing;
  for (int tet = 0; tet < m.tets.count; ++tet) {
    auto const t = static_cast<std::size_t>(tet);
    double const G = m.tets.shear_modulus[t], lambda = m.tets.lame[t], norm = gradient_norm(m, t);
    TetBound b;
    for (int a = 0; a < 4; ++a) {
      double const inverse = m.tets.inverse_mass[model::at(t, a, 4)];
      double const own_mass = m.mass[4 * t + static_cast<std::size_t>(a)];
      // a bonded node's frequency is at most that of its stiffest tet alone (Rayleigh), so the own mass counts
      b.own = std::max(b.own, m.tets.volume[t] * (2 * G + 3 * lambda) * norm / own_mass);
      b.viscous = std::max(b.viscous, m.tets.volume[t] * m.tets.viscosity[t] * norm / own_mass);
      b.joints = std::max(b.joints, 2 * inverse * joint_k[4 * t + static_cast<std::size_t>(a)]);
      b.bars = std::max(b.bars, 2 * inverse * bar_k[4 * t + static_cast<std::size_t>(a)]);
    }
    if (best.tet >= 0 && b.dt() >= best.dt) continue;
    best.dt = b.dt();
    best.tet = tet;
    governing = b;
  }
  best.omega = std::sqrt(governing.own + governing.joints + governing.bars);
  char const* const lead = governing.bars > governing.joints && governing.bars > governing.own ? "bar joint"
                           : governing.joints > governing.own                                  ? "joint"
                                                                                               : "tet";
  auto const c = mesh::corners(m.mesh, best.tet);
  Vec3 const at = 0.25 * (c[0] + c[1] + c[2] + c[3]);
  best.limiter = fmt::format("{} at tet {} ({:.4g}, {:.4g}, {:.4g}) m", lead, m.mesh.input_id[best.tet], at.x, at.y, at.z);
  return best;
}

} // namespace fissura::step
