#pragma once
// Reinforcing steel under cyclic load by one smooth curve per half cycle, with isotropic hardening.
//
// Source: Giuffre and Pinto (1970), Menegotto and Pinto (1973); isotropic shift by Filippou, Popov and
// Bertero (1983). Parameters: SteelParams (eps_sh is not used: the curve has no plateau). Constants,
// dimensionless: R_0 = 20, a_1 = 18.5, a_2 = 0.15 (roundness), a_3 = 0.01, a_4 = 7 (shift). History:
// SteelHistory. Misprints: none known. Theory: docs/theory/steel_menegotto_pinto.md.
#include "fissura/laws/steel_history.hpp"
#include "fissura/laws/steel_params.hpp"

namespace fissura::laws {

using MenegottoPintoHistory = SteelHistory;

struct SteelMenegottoPinto {
  SteelParams params;
  /// Stress [Pa] at the next strain; advances the history. At most f_u; ruptures for good at eps_br.
  double operator()(MenegottoPintoHistory& h, double strain) const noexcept;
  /// The strength of `params` has fallen since the last strain: a stress beyond it is lost.
  void weaken(MenegottoPintoHistory& h) const noexcept;
};

} // namespace fissura::laws
