#pragma once
// Reinforcing steel under cyclic load by Kato's curves.
//
// Source: Fig. 10 and Eq. 27 of the founding paper, after Kato (1979).
// Parameters: SteelParams. History: KatoHistory. No empirical constant carries a unit.
// Misprints: Eq. 27 has eps_sh where the largest strain reached is meant, in curves (1), (2) and in E_B; the
// argument of the logarithm is 10 (eps_max - eps_y). Table 6 gives eps_br = 0.019 < eps_u = 0.1; 0.12 is
// meant. Theory: docs/theory/steel_kato.md.
#include "fissura/laws/steel_params.hpp"

namespace fissura::laws {

struct KatoHistory {
  double strain = 0, stress = 0; ///< last evaluation [-], [Pa]
  double eps_v = 0, sigma_v = 0; ///< last reversal, start of the elastic line
  double eps_max = 0;            ///< largest strain so far beyond yield, as it was then; 0: never yielded
  double eps_z = -1e30;          ///< largest strain at which an unloading line crossed zero stress
  double eps_pm = 1e30, share_pm = 0; ///< last compressive reversal; its stress over f_y, which may fall
  double E_B_unloading = 0;           ///< E_B of curve (2), frozen at reversal from tension [Pa]
  double E_B_loading = 0;             ///< E_B of curve (4), frozen at reversal from compression [Pa]
  int direction = 0;                  ///< +1 loading, -1 unloading, 0 at the start
  bool ruptured = false;
};

/// Monotonic curve in tension [Pa]; 0 beyond eps_br.
double kato_envelope(SteelParams const& p, double strain) noexcept;

struct SteelKato {
  SteelParams params;
  /// Stress [Pa] at the next strain; advances the history. Ruptures for good at eps_br.
  double operator()(KatoHistory& h, double strain) const noexcept;
};

} // namespace fissura::laws
