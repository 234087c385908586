#pragma once
// Reinforcing steel under cyclic load by Kato's curves.
//
// Source: Fig. 10 and Eq. 27 of the founding paper, after Kato (1979).
// Parameters: SteelParams. History: SteelHistory. No empirical constant carries a unit.
// Misprints: Eq. 27 has eps_sh where the largest strain reached is meant, in curves (1), (2) and in E_B; the
// argument of the logarithm is 10 (eps_max - eps_y). Table 6 gives eps_br = 0.019 < eps_u = 0.1; 0.12 is
// meant. Theory: docs/theory/steel_kato.md.
#include "fissura/laws/steel_history.hpp"
#include "fissura/laws/steel_params.hpp"

namespace fissura::laws {

using KatoHistory = SteelHistory;

/// Monotonic curve in tension [Pa]; 0 beyond eps_br.
double kato_envelope(SteelParams const& p, double strain) noexcept;

struct SteelKato {
  SteelParams params;
  /// Stress [Pa] at the next strain; advances the history. Ruptures for good at eps_br.
  double operator()(KatoHistory& h, double strain) const noexcept;
  /// The strength of `params` has fallen since the last strain: a stress beyond it is lost.
  void weaken(KatoHistory& h) const noexcept;
};

} // namespace fissura::laws
