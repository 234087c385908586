#include "fissura/laws/steel_menegotto_pinto.hpp"

#include <algorithm>
#include <cmath>

namespace fissura::laws {

namespace {

constexpr double R_0 = 20, a_1 = 18.5, a_2 = 0.15, a_3 = 0.01, a_4 = 7;

/// Below this share of eps_y the virgin curve is taken as straight (it differs by 5e-8): no power is needed
/// there.
constexpr double straight_until = 0.5;

double hardening(SteelParams const& p) {
  return (p.f_u - p.f_y) / (p.eps_u - p.eps_y()) / p.E_s;
}

/// Strain from the reversal to the corner where the elastic line meets the yield asymptote.
double strain_to_corner(SteelParams const& p, MenegottoPintoHistory const& h, double b) {
  double const yield = h.direction * p.f_y * (1 - b) * (1 + h.shift) + b * p.E_s * h.eps_r;
  return (yield - h.sigma_r) / (p.E_s * (1 - b));
}

void turn(SteelParams const& p, MenegottoPintoHistory& h, int direction) {
  bool const first = h.direction == 0;
  h.direction = direction;
  if (first) return;
  h.eps_r = h.strain, h.sigma_r = h.stress;
  double const extreme = std::max(h.eps_largest, -h.eps_smallest);
  h.shift = std::max(0.0, a_3 * (extreme / p.eps_y() - a_4));
  double const corner = h.eps_r + strain_to_corner(p, h, hardening(p));
  double const target =
      direction > 0 ? std::max(h.eps_largest, p.eps_y()) : std::min(h.eps_smallest, -p.eps_y());
  double const xi = std::abs(target - corner) / p.eps_y();
  h.roundness = R_0 - a_1 * xi / (a_2 + xi);
}

double branch(SteelParams const& p, MenegottoPintoHistory const& h, double strain) {
  double const b = hardening(p), span = strain_to_corner(p, h, b);
  double const from = strain - h.eps_r;
  if (span * h.direction <= 1e-9 * p.eps_y()) return h.sigma_r + b * p.E_s * from; // already on the asymptote
  double const x = from / span;
  double const curve = x / std::pow(1 + std::pow(std::abs(x), h.roundness), 1 / h.roundness);
  return h.sigma_r + p.E_s * span * (b * x + (1 - b) * curve);
}

} // namespace

double SteelMenegottoPinto::operator()(MenegottoPintoHistory& h, double strain) const noexcept {
  auto const& p = params;
  if (h.ruptured) {
    h.strain = strain;
    return 0;
  }
  bool const virgin = h.direction == 0 && std::abs(strain) <= straight_until * p.eps_y();
  if (virgin) {
    h.stress = p.E_s * strain;
  } else {
    if (strain != h.strain) {
      int const direction = strain > h.strain ? 1 : -1;
      if (direction != h.direction) turn(p, h, direction);
    }
    h.stress = std::clamp(branch(p, h, strain), -p.f_u, p.f_u);
  }
  h.strain = strain;
  h.eps_largest = std::max(h.eps_largest, strain);
  h.eps_smallest = std::min(h.eps_smallest, strain);
  if (strain >= p.eps_br) h.ruptured = true, h.stress = 0;
  return h.stress;
}

} // namespace fissura::laws
