#pragma once
// Steel by the law its parameters name: one switch, no virtual call.
#include "fissura/laws/steel_kato.hpp"
#include "fissura/laws/steel_menegotto_pinto.hpp"

namespace fissura::laws {

/// Stress [Pa] at the next strain; `strength` (0 ... 1) multiplies f_y and f_u (Eq. 24).
inline double steel_stress(SteelParams const& p, SteelHistory& h, double strain,
                           double strength = 1) noexcept {
  SteelParams const now = reduced(p, strength);
  if (p.law == SteelLaw::menegotto_pinto) return SteelMenegottoPinto{now}(h, strain);
  return SteelKato{now}(h, strain);
}

/// Shear has lowered the strength to the share `strength`: at the last strain, a stress beyond it is lost.
inline void weaken_steel(SteelParams const& p, SteelHistory& h, double strength) noexcept {
  SteelParams const now = reduced(p, strength);
  if (p.law == SteelLaw::menegotto_pinto) return SteelMenegottoPinto{now}.weaken(h);
  SteelKato{now}.weaken(h);
}

inline bool is_ruptured(SteelParams const&, SteelHistory const& h) noexcept {
  return h.ruptured;
}

} // namespace fissura::laws
