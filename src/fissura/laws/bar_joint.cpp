#include "fissura/laws/bar_joint.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "fissura/core/error.hpp"

namespace fissura::laws {

namespace {

/// A bar whose shear leaves it less than this share of its strength is cut.
constexpr double least_strength = 0.01;
/// Transverse half slip over diameter at which a bar is cut.
constexpr double largest_offset = 3;

/// Energy [J] that unloading from `sigma` to zero along the slope ds/deps gives back: A_s sigma works on 2 S.
double recoverable(BarJointParams const& p, double slope, double sigma) {
  return p.energy_factor * slope * sigma * sigma;
}

/// The same for the point the joint is at. In a closed crack the stress runs back along the line of the
/// closed crack to what it will be where that ends, and from there along the line of the open one.
double recoverable_now(BarJointParams const& p, BarJointHistory const& h) {
  double const slope = unloading_slope(p.bond, h.bond);
  if (!is_pressed(p.bond, h.bond, h.S)) return recoverable(p, slope, h.sigma);
  double const closed = closed_slope(p.bond, h.bond);
  return recoverable(p, closed, h.sigma) + recoverable(p, slope - closed, h.at_closing);
}

/// The stress that the bar in a closed crack will have where the line of the closed crack ends.
double stress_at_closing(BarJointParams const& p, BarJointHistory const& h) {
  SteelHistory ahead = h.steel;
  return steel_stress(p.steel, ahead, strain_at_closing(p.bond, h.bond), h.dowel.strength);
}

bool must_rupture(BarJointParams const& p, BarJointHistory const& h, double t_s) {
  return h.strain > p.steel.eps_br || t_s >= largest_offset * p.D || h.dowel.strength <= least_strength;
}

} // namespace

BarJointParams make_bar_joint_params(BarJointInput const& in) {
  bool const paper = in.l_cr > 0;
  if (!paper && !(in.l_g > 0 && in.l_b > 0))
    throw core::Error(core::Failure::input,
                      "bar joint: the crack distance l_cr, or l_g and l_b, must be positive");
  BarJointParams p;
  p.D = in.D, p.A_s = in.A_s, p.steel = in.steel, p.with_dowel = in.dowel;
  double const alpha = paper ? slip_reduction(in.l_cr / in.D)
                             : consistent_reduction(in.D, in.f_c, in.steel.eps_y(), in.l_g, in.l_b);
  p.bond = make_bond_params({in.D, in.f_c, alpha, paper ? 0 : in.l_g}, in.steel);
  p.energy_factor = in.A_s / (p.bond.normalise * in.steel.E_s);
  p.dowel = make_dowel_params({in.D, in.A_s, in.steel.E_s, in.steel.f_y, in.f_c});
  return p;
}

double activate(BarJointParams const& p, BarJointHistory& h, double S_0, Vec3 t_0, double sigma_cr,
                double stored) noexcept {
  h = {};
  h.activated = true;
  h.S_0 = S_0, h.t_0 = t_0, h.stored_0 = stored;
  h.bond.sigma_cr = sigma_cr;
  h.strain = bond_strain(p.bond, h.bond, 0, 1);
  h.sigma = steel_stress(p.steel, h.steel, h.strain);
  bool const keeps_its_stress = std::abs(h.sigma - sigma_cr) <= 1e-9 * p.steel.f_y;
  return keeps_its_stress ? 0 : stored - bar_joint_axial_stored(p, h);
}

BarJointForce bar_joint_force(BarJointParams const& p, BarJointHistory& h, double S, double t_s,
                              BarJointDissipation& lost, bool touching) noexcept {
  if (h.ruptured) return {};
  double const axial_before = bar_joint_axial_stored(p, h), dowel_softening = h.dowel.softening;
  double const sigma_before = h.sigma, S_before = h.S, t_before = h.t_s, V_before = h.V_s;
  double const strength_before = h.dowel.strength;

  h.S = S, h.t_s = t_s;
  h.V_s = p.with_dowel ? dowel_force(p.dowel, h.dowel, S, t_s) : 0;
  // A bar that still pulls harder than when the crack opened keeps to the line of the open crack: the line of
  // the closed one would give back more than it took, and shear could then weaken the bar before it is taken
  // again.
  bool const closes = touching && (h.bond.closed || h.sigma <= std::max(0.0, h.bond.sigma_cr));
  h.strain = bond_strain(p.bond, h.bond, S, h.dowel.strength, closes);
  if (h.dowel.strength < strength_before) weaken_steel(p.steel, h.steel, h.dowel.strength);
  h.sigma = steel_stress(p.steel, h.steel, h.strain, h.dowel.strength);
  h.at_closing = is_pressed(p.bond, h.bond, S) ? stress_at_closing(p, h) : 0;
  h.yielded = h.yielded || h.bond.yielded || h.strain < -p.steel.f_y / p.steel.E_s;

  if (must_rupture(p, h, t_s)) {
    lost.dowel += V_before * t_s; // what it held, V t before, and the trapezoidal work of the last step
    h.ruptured = true, h.sigma = 0, h.V_s = 0;
  } else if (p.with_dowel) {
    // The fall of stiffness at the slip of the step: with the trapezoidal work this closes the balance
    // exactly.
    lost.dowel += p.dowel.stiffness * (dowel_softening - h.dowel.softening) * t_before * t_s;
  }
  double const work = p.A_s * (sigma_before + h.sigma) * (S - S_before); // trapezoid of A_s sigma over 2 S
  lost.bond_steel += work - (bar_joint_axial_stored(p, h) - axial_before);
  return {h.sigma, h.V_s};
}

double bar_joint_axial_stored(BarJointParams const& p, BarJointHistory const& h) noexcept {
  if (!h.activated || h.ruptured) return 0;
  return h.stored_0 + recoverable_now(p, h) - recoverable(p, p.bond.k_e, h.bond.sigma_cr);
}

double bar_joint_stored(BarJointParams const& p, BarJointHistory const& h) noexcept {
  if (!h.activated || h.ruptured) return 0;
  return bar_joint_axial_stored(p, h) + (p.with_dowel ? dowel_stored(p.dowel, h.dowel, h.t_s) : 0);
}

} // namespace fissura::laws
