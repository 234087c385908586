#include "fissura/laws/bond_slip.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "fissura/core/error.hpp"

namespace fissura::laws {

namespace {

constexpr double MPa = 1e6;

/// Share of the slip at yield over which the strain runs from eps_y to eps_sh.
constexpr double ramp_share = 1e-3;

/// Strain from which the steel hardens. Without a plateau that is the yield strain: nothing jumps.
double onset_of_hardening(BondParams const& p, BondCurve const& c) {
  return std::max(p.eps_sh, c.eps_y);
}

double monotonic_strain(BondParams const& p, BondCurve const& c, double s) {
  double const beyond = s - c.s_y, onset = onset_of_hardening(p, c);
  if (beyond < c.ramp) return c.eps_y + (onset - c.eps_y) * beyond / c.ramp;
  if (s <= c.s_0) return onset + (beyond - c.ramp) / c.H1;
  return c.eps_0 + (s - c.s_0) / c.H2;
}

/// The slip at which the monotonic curve has the strain `eps` >= eps_y.
double monotonic_slip(BondParams const& p, BondCurve const& c, double eps) {
  double const onset = onset_of_hardening(p, c);
  if (eps < onset) return c.s_y + c.ramp * (eps - c.eps_y) / (onset - c.eps_y);
  if (eps <= c.eps_0) return c.s_y + c.ramp + c.H1 * (eps - onset);
  return c.s_0 + c.H2 * (eps - c.eps_0);
}

double elastic_strain(BondParams const& p, BondHistory const& h, double s) {
  return s / p.k_e + h.sigma_cr / p.E_s;
}

void weaken(BondParams const& p, BondHistory& h, double strength) {
  h.curve = bond_curve(p, strength, h.sigma_cr);
  // A yielded bar goes on from its strain with the new slopes. Jumping to the new curve would stretch the
  // steel without slip, and where its stress is below the envelope that creates energy.
  if (h.yielded) h.shift = monotonic_slip(p, h.curve, h.eps_max) - h.s_max;
}

} // namespace

double slip_reduction(double l_cr_over_D) noexcept {
  double const x = 0.065 * l_cr_over_D + 0.5;
  return std::min(1 - std::exp(-x * x * x), 0.087 * l_cr_over_D);
}

BondParams make_bond_params(BondInput const& in, SteelParams const& steel) {
  auto require = [](bool ok, char const* what) {
    if (!ok) throw core::Error(core::Failure::input, std::string("bond: ") + what);
  };
  require(in.D > 0, "the bar diameter D must be positive");
  require(in.f_c > 0, "the compressive strength f_c must be positive");
  require(in.alpha > 0 && in.alpha <= 1, "the reduction alpha must lie in (0, 1]");
  check_steel_params(steel);
  BondParams p;
  p.normalise = std::cbrt(std::pow(in.f_c / MPa / 20, 2)) / in.D;
  p.alpha = in.alpha;
  p.k_e = in.alpha * (2 + 3500 * steel.eps_y());
  p.E_s = steel.E_s, p.f_y = steel.f_y, p.f_u = steel.f_u;
  if (steel.law == SteelLaw::kato) p.eps_sh = steel.eps_sh;
  return p;
}

BondCurve bond_curve(BondParams const& p, double strength, double sigma_cr) noexcept {
  BondCurve c;
  c.strength = strength;
  c.eps_y = strength * p.f_y / p.E_s;
  double const hardening = std::max(1.0, strength * (p.f_u - p.f_y) / MPa);
  double const s_full = p.k_e * c.eps_y; // slip at yield of a bar without stress at activation
  c.s_y = s_full - p.k_e * std::min(sigma_cr / p.E_s, 0.95 * c.eps_y);
  c.H1 = 0.047 * p.alpha * hardening;
  c.H2 = 0.007 * p.alpha * hardening;
  double const onset = onset_of_hardening(p, c);
  c.ramp = onset > c.eps_y ? ramp_share * s_full : 0;
  c.eps_0 = std::max(onset, onset + (0.06 - 0.5 * s_full / p.alpha) / (0.013 * hardening));
  c.s_0 = c.s_y + c.ramp + c.H1 * (c.eps_0 - onset);
  return c;
}

double bond_strain(BondParams const& p, BondHistory& h, double S, double strength) noexcept {
  if (strength != h.curve.strength) weaken(p, h, strength);
  double const s = S * p.normalise;
  if (!h.yielded) {
    if (s <= h.curve.s_y) return elastic_strain(p, h, s);
    h.yielded = true;
    // A bar that shear has left less strength than the stress it had when the crack opened yields at a larger
    // strain than the curve begins with, and goes on from there.
    double const now = elastic_strain(p, h, h.curve.s_y);
    if (now > h.curve.eps_y * (1 + 1e-9)) h.shift = monotonic_slip(p, h.curve, now) - h.curve.s_y;
  } else if (s <= h.s_max) {
    return h.eps_max - (h.s_max - s) / h.K; // Eqs. 21, 22 with beta = 1
  }
  h.s_max = s;
  h.eps_max = monotonic_strain(p, h.curve, s + h.shift);
  h.K = p.k_e + 2 * (s + h.shift - h.curve.s_y) / (h.eps_max + onset_of_hardening(p, h.curve));
  return h.eps_max;
}

} // namespace fissura::laws
