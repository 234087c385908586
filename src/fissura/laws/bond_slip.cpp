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

/// Strain on the line along which the bar unloads now: the elastic line, or after yield Eqs. 21, 22 with beta
/// = 1.
double line_strain(BondParams const& p, BondHistory const& h, double s) {
  return h.yielded ? h.eps_max - (h.s_max - s) / h.K : elastic_strain(p, h, s);
}

double to_normalise(double D, double f_c) {
  return std::cbrt(std::pow(f_c / MPa / 20, 2)) / D;
}

void weaken(BondParams const& p, BondHistory& h, double strength, double s) {
  h.curve = bond_curve(p, strength, h.sigma_cr);
  // A crack that has closed beyond the new yield slip opens again on the line it closed from, and yields from
  // there on: its strain must not jump.
  if (!h.yielded && h.closed && s < h.s_closed && h.s_closed > h.curve.s_y)
    h.eps_max = elastic_strain(p, h, h.s_closed), h.s_max = h.s_closed, h.K = p.k_e, h.yielded = true;
  // A yielded bar goes on from its strain with the new slopes. Jumping to the new curve would stretch the
  // steel without slip, and where its stress is below the envelope that creates energy.
  if (h.yielded) h.shift = monotonic_slip(p, h.curve, h.eps_max) - h.s_max;
}

/// Strain on the curve of an open crack. Advances the history.
double open_strain(BondParams const& p, BondHistory& h, double s) {
  if (!h.yielded) {
    if (s <= h.curve.s_y) return elastic_strain(p, h, s);
    h.yielded = true;
    // A bar that shear has left less strength than the stress it had when the crack opened yields at a larger
    // strain than the curve begins with, and goes on from there.
    double const now = elastic_strain(p, h, h.curve.s_y);
    if (now > h.curve.eps_y * (1 + 1e-9)) h.shift = monotonic_slip(p, h.curve, now) - h.curve.s_y;
  } else if (s <= h.s_max) {
    return line_strain(p, h, s);
  }
  h.s_max = s;
  h.eps_max = monotonic_strain(p, h.curve, s + h.shift);
  h.K = p.k_e + 2 * (s + h.shift - h.curve.s_y) / (h.eps_max + onset_of_hardening(p, h.curve));
  return h.eps_max;
}

} // namespace

double slip_reduction(double l_cr_over_D) noexcept {
  double const x = 0.065 * l_cr_over_D + 0.5;
  return std::min(1 - std::exp(-x * x * x), 0.087 * l_cr_over_D);
}

double mean_over_crack_strain(double x) noexcept {
  return x <= 1 ? 1 - 0.5 * x : 0.5 / x;
}

double consistent_reduction(double D, double f_c, double eps_y, double l_g, double l_b) noexcept {
  double const per_strain = (2 + 3500 * eps_y) / to_normalise(D, f_c); // slip over strain, one crack alone
  return mean_over_crack_strain(0.5 * l_b / per_strain) * l_g / per_strain;
}

BondParams make_bond_params(BondInput const& in, SteelParams const& steel) {
  auto require = [](bool ok, char const* what) {
    if (!ok) throw core::Error(core::Failure::input, std::string("bond: ") + what);
  };
  require(in.D > 0, "the bar diameter D must be positive");
  require(in.f_c > 0, "the compressive strength f_c must be positive");
  require(in.alpha > 0, "the reduction alpha must be positive");
  require(in.l_g >= 0, "the length l_g must not be negative");
  check_steel_params(steel);
  BondParams p;
  p.normalise = to_normalise(in.D, in.f_c);
  p.alpha = in.alpha;
  p.k_e = in.alpha * (2 + 3500 * steel.eps_y());
  p.k_closed = in.l_g * p.normalise;
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

double closed_slope(BondParams const& p, BondHistory const& h) noexcept {
  return std::max(p.k_closed, unloading_slope(p, h));
}

double strain_at_closing(BondParams const& p, BondHistory const& h) noexcept {
  return line_strain(p, h, h.s_closed);
}

double bond_strain(BondParams const& p, BondHistory& h, double S, double strength, bool touching) noexcept {
  double const s = S * p.normalise;
  if (strength != h.curve.strength) weaken(p, h, strength, s);
  // A crack that opens again short of where it closed has slid: it follows the line of the closed crack back.
  if (is_pressed(p, h, S)) return strain_at_closing(p, h) + (s - h.s_closed) / closed_slope(p, h);
  double const strain = open_strain(p, h, s);
  bool const closed = touching && p.k_closed > 0;
  if (closed && !h.closed) h.s_closed = s;
  h.closed = closed;
  return strain;
}

} // namespace fissura::laws
