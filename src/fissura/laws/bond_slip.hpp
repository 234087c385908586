#pragma once
// Strain of a reinforcing bar at a crack from the slip of the bar out of the crack face.
//
// Source: Eqs. 20-22, 25, 26 of the founding paper, after Soltani and Maekawa (2008) and Shima et al. (1987).
// Not in the paper: the consistent reduction, which takes the place of Eq. 26, and the line of a closed
// crack. Parameters: BondInput. History: BondHistory. Empirical constants want f in MPa: 20 in K_fc, 0.047,
// 0.007, 0.013. The others carry no unit. Misprints: Eq. 26, alpha = min(1 - exp(-(0.065 l_cr/D + 0.5)^3),
// 0.087 l_cr/D). Theory: docs/theory/bond_slip.md.
#include "fissura/laws/steel_params.hpp"

namespace fissura::laws {

struct BondInput {
  double D = 0;     ///< bar diameter [m], > 0
  double f_c = 0;   ///< compressive strength of the concrete [Pa], > 0
  double alpha = 1; ///< reduction by the next crack (Eqs. 25, 26, or consistent_reduction) [-], > 0
  double l_g = 0;   ///< bar that each face of a closed crack stands for [m]; 0: open or closed is all one
};

struct BondParams {
  double normalise = 0; ///< K_fc/D: normalised slip s per slip S (Eq. 20) [1/m]
  double alpha = 1;
  double k_e = 0;      ///< elastic s per strain, alpha (2 + 3500 eps_y) [-]
  double k_closed = 0; ///< s per strain in a closed crack, l_g K_fc/D [-]; 0: as in an open one
  double E_s = 0, f_y = 0, f_u = 0;
  double eps_sh = 0; ///< 0: the steel has no plateau (Menegotto-Pinto)
};

/// Reduction alpha (Eq. 26, corrected) for the distance l_cr to the next crack over the diameter.
double slip_reduction(double l_cr_over_D) noexcept;

/// Mean strain of the bar between two cracks over its strain at the cracks, x half their distance over the
/// length of bar that bond needs to take the whole stress out of it: 1 - x/2, or 1/(2x) from x = 1 on.
double mean_over_crack_strain(double x) noexcept;

/// The reduction alpha with which each face of a crack slips by S = l_g times the mean strain: 2 l_b is the
/// distance of cracks, l_g the length of bar that the face stands for [m].
double consistent_reduction(double D, double f_c, double eps_y, double l_g, double l_b) noexcept;

/// Throws core::Error (input) naming the first parameter outside its range.
BondParams make_bond_params(BondInput const& input, SteelParams const& steel);

/// The monotonic curve for one reduction of the yield stress; all in normalised slip and strain.
struct BondCurve {
  double strength = 0;       ///< share of f_y and f_u left by shear (Eq. 24); 0 = not computed yet
  double eps_y = 0;          ///< yield strain, reduced
  double s_y = 0;            ///< slip at yield
  double ramp = 0;           ///< width of the ramp that stands for the jump eps_y -> eps_sh; 0: none
  double H1 = 0, H2 = 0;     ///< slip per strain after yield and beyond eps_0
  double eps_0 = 0, s_0 = 0; ///< where H1 ends, ramp included
};
BondCurve bond_curve(BondParams const& p, double strength, double sigma_cr) noexcept;

struct BondHistory {
  double sigma_cr = 0; ///< stress of the bar when the crack opened [Pa]
  BondCurve curve;     ///< recomputed only when the strength changes
  double s_max = 0;    ///< largest normalised slip since yield
  double shift =
      0; ///< added to s on the monotonic curve: keeps the strain continuous when the strength falls
  double eps_max = 0; ///< strain there
  double K = 0;       ///< slope ds/deps of unloading, frozen at s_max
  bool yielded = false;
  bool closed = false; ///< the crack has closed: below s_closed the bar is strained as the concrete beside it
  double s_closed = 0; ///< normalised slip at which it closed
};

/// Strain at the crack for the slip S [m] (half the crack's opening along the bar, counted from activation).
/// `strength` is the reduction of Eq. 24; `touching`: the faces of the crack touch now. Advances the history.
double bond_strain(BondParams const& p, BondHistory& h, double S, double strength,
                   bool touching = false) noexcept;

/// Whether the slip S [m] lies on the line of a closed crack.
inline bool is_pressed(BondParams const& p, BondHistory const& h, double S) noexcept {
  return h.closed && S * p.normalise < h.s_closed;
}
/// Slope ds/deps of the line of a closed crack [-]: l_g, or the slope of the line it leaves where that is
/// larger. With a smaller one a yielded bar could be stressed in the closed crack at less work than it gives
/// back in the open one.
double closed_slope(BondParams const& p, BondHistory const& h) noexcept;
/// Strain at which that line ends.
double strain_at_closing(BondParams const& p, BondHistory const& h) noexcept;

/// Slope ds/deps along which the bar unloads now [-].
inline double unloading_slope(BondParams const& p, BondHistory const& h) noexcept {
  return h.yielded ? h.K : p.k_e;
}

} // namespace fissura::laws
