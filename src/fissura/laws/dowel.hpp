#pragma once
// Dowel action: a bar that crosses a crack resists its sliding by bending, and the shear in it lowers its
// yield stress.
//
// Source: Eqs. 23, 24 of the founding paper, after Qureshi and Maekawa (1993).
// Parameters: DowelInput. History: DowelHistory.
// Empirical constants want N, mm, MPa: 150 f_c^0.85 (bedding of the bar), 150 S/D; 0.02, 3, 0.8 carry no
// unit. Misprints: none known; 34.9091 is 384/11. Theory: docs/theory/dowel.md.

namespace fissura::laws {

struct DowelInput {
  double D = 0;   ///< bar diameter [m], > 0
  double A_s = 0; ///< steel area [m2]; more than pi D^2/4 stands for several bars
  double E_s = 0; ///< [Pa]
  double f_y = 0; ///< yield stress [Pa]
  double f_c = 0; ///< compressive strength of the concrete [Pa]
};

struct DowelParams {
  double D = 0, A_s = 0, f_y = 0;
  double L_c0 = 0;      ///< length of the bent zone with little damage [m]
  double stiffness = 0; ///< V_s/t_s with L_c0, all bars together [N/m]
};

/// Throws core::Error (input) naming the first parameter outside its range.
DowelParams make_dowel_params(DowelInput const& input);

struct DowelHistory {
  double DI = 0;        ///< largest damage index so far [-]
  double softening = 1; ///< (L_c0/L_c)^3 at that index
  double V_max = 0;     ///< largest force so far [N]
  double strength = 1;  ///< share of f_y that V_max leaves (Eq. 24)
};

/// Dowel force V_s [N] at the transverse half slip t_s >= 0 and the slip S [m] (S < 0 counts as 0). Advances
/// the history.
double dowel_force(DowelParams const& p, DowelHistory& h, double S, double t_s) noexcept;

/// Energy in the dowel [J]: the force V_s works on the whole offset 2 t_s.
inline double dowel_stored(DowelParams const& p, DowelHistory const& h, double t_s) noexcept {
  return p.stiffness * h.softening * t_s * t_s;
}

/// Largest slope of V_s over the whole offset 2 t_s [N/m], for the stable step.
inline double dowel_stiffness_bound(DowelParams const& p) noexcept {
  return 0.5 * p.stiffness;
}

} // namespace fissura::laws
