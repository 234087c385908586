#pragma once
// What all steel laws share: the monotonic curve by its characteristic points.

namespace fissura::laws {

enum class SteelLaw { kato, menegotto_pinto };

struct SteelParams {
  double E_s = 200e9;    ///< Young's modulus [Pa], > 0
  double f_y = 0;        ///< yield stress [Pa], > 0
  double f_u = 0;        ///< tensile strength [Pa], > f_y
  double eps_sh = 0.015; ///< strain at the onset of hardening, > f_y/E_s
  double eps_u = 0.1;    ///< strain at the tensile strength, > eps_sh
  double eps_br = 0.12;  ///< strain at rupture, > eps_u
  SteelLaw law = SteelLaw::kato;

  double eps_y() const noexcept { return f_y / E_s; }
};

/// The same steel with both strengths times `strength` (0 ... 1): shear in the bar reduces them (Eq. 24).
inline SteelParams reduced(SteelParams p, double strength) noexcept {
  p.f_y *= strength, p.f_u *= strength;
  return p;
}

/// Throws core::Error (input) naming the first parameter outside its range.
void check_steel_params(SteelParams const& p);

/// Energy per volume that unloading gives back [J/m3]: every unloading line of these laws has the slope E_s.
inline double steel_recoverable(SteelParams const& p, double stress) noexcept {
  return 0.5 * stress * stress / p.E_s;
}

} // namespace fissura::laws
