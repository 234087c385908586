#pragma once
// A bar where it passes from one tet to the next, before the concrete there has cracked: it follows the
// joint.
//
// Source: section 2.3.1 and Fig. 5 of the founding paper (no equation is given there): the stress is
// (E_s/E_c) times the traction that the undamaged joints (Eq. 13) carry along the bar. History: none. Theory:
// docs/theory/bar_joint.md.
#include <limits>

namespace fissura::laws {

/// Make one with `uncracked_bar_joint`.
struct UncrackedBarJoint {
  double slope = 0; ///< initial slope of the stress over the separation [Pa/m]
  double d_peak = std::numeric_limits<double>::infinity(); ///< separation at the peak [m]; infinite: linear
  double A_s = 0;                                          ///< [m2]

  /// Stress [Pa] at the separation d.r [m] of P_A and P_B along the bar.
  double stress(double d) const noexcept {
    if (d <= 0) return slope * d;
    double const below = d < d_peak ? d : d_peak;
    return slope * below * (1 - 0.5 * below / d_peak);
  }
  /// Energy [J], the work of A_s stress over d.r: a state function.
  double stored(double d) const noexcept {
    if (d <= 0) return 0.5 * A_s * slope * d * d;
    double const below = d < d_peak ? d : d_peak;
    double const curve = 0.5 * slope * below * below * (1 - below / (3 * d_peak));
    return A_s * (d > d_peak ? curve + stress(d) * (d - d_peak) : curve);
  }
  /// Largest slope of the force over d.r [N/m], for the stable step.
  double stiffness_bound() const noexcept { return slope * A_s; }
};

/// H: sum of h |n.r| over the faces C crossed [m]; p penalty [Pa]; modular_ratio E_s/E_c; f_t of the weakest
/// face [Pa]. Not crackable: linear for ever.
inline UncrackedBarJoint uncracked_bar_joint(double modular_ratio, double p, double H, double f_t, double A_s,
                                             bool crackable) noexcept {
  UncrackedBarJoint u;
  u.slope = modular_ratio * p / H;
  if (crackable) u.d_peak = 2 * f_t * H / p;
  u.A_s = A_s;
  return u;
}

} // namespace fissura::laws
