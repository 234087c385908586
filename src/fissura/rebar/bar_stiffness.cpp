#include <algorithm>
#include <cmath>

#include "fissura/rebar/rebar.hpp"

namespace fissura::rebar {

namespace {

using Weights = std::array<double, 4>;

double sum_of_sizes(Weights const& w) {
  return std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2]) + std::abs(w[3]);
}

Weights middle(model::BarElement const& e) {
  Weights w;
  for (int c = 0; c < 4; ++c) w[c] = 0.5 * (e.w0[c] + e.w1[c]);
  return w;
}

/// Half the row sums of k g g^T: g = -a on one tet and b on the other.
Weights row_sums(double k, Weights const& a, Weights const& b) {
  Weights rows;
  double const all = 0.5 * (sum_of_sizes(a) + sum_of_sizes(b));
  for (int c = 0; c < 4; ++c) rows[c] = k * std::abs(a[c]) * all;
  return rows;
}

void add_larger(std::span<double> stiffness, int tet, Weights const& x, Weights const& y) {
  for (int c = 0; c < 4; ++c) stiffness[static_cast<std::size_t>(4 * tet + c)] += std::max(x[c], y[c]);
}

} // namespace

void add_bar_stiffness(model::Bars const& bars, std::span<double> stiffness) {
  for (auto const& e : bars.elements) {
    auto const& bar = bars.properties[e.bar];
    Weights g;
    for (int c = 0; c < 4; ++c) g[c] = e.w1[c] - e.w0[c];
    double const k = 0.5 * bar.steel.E_s * bar.area / e.length * sum_of_sizes(g);
    for (int c = 0; c < 4; ++c) stiffness[static_cast<std::size_t>(4 * e.tet + c)] += k * std::abs(g[c]);
  }
  bool const slip_only = bars.settings.between_cracks == model::BarBetweenCracks::slip_only;
  for (std::size_t i = 0; i < bars.joints.size(); ++i) {
    auto const& j = bars.joints[i];
    auto const& law = bars.joint_law[i];
    double const slip = law.crackable ? laws::bar_joint_stiffness_bound(law.activated) : 0;
    double const dowel =
        law.crackable && bars.settings.dowel ? laws::dowel_stiffness_bound(law.activated.dowel) : 0;
    // At P: the intact joint and the dowel. The slip spring reaches from the middle of one element to that of
    // the other.
    double const at_p = std::max({law.intact.stiffness_bound(), dowel, slip_only ? 0 : slip});
    double const at_middle = slip_only ? slip : 0;
    Weights const mid_a = middle(bars.elements[j.elem_a]), mid_b = middle(bars.elements[j.elem_b]);
    add_larger(stiffness, j.tet_a, row_sums(at_p, j.w_a, j.w_b), row_sums(at_middle, mid_a, mid_b));
    add_larger(stiffness, j.tet_b, row_sums(at_p, j.w_b, j.w_a), row_sums(at_middle, mid_b, mid_a));
  }
}

} // namespace fissura::rebar
