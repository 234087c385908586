#pragma once
// Steel by the law its parameters name: one switch, no virtual call.
#include "fissura/laws/steel_kato.hpp"
#include "fissura/laws/steel_menegotto_pinto.hpp"

namespace fissura::laws {

/// Only the member of the chosen law is used.
struct SteelHistory {
  KatoHistory kato;
  MenegottoPintoHistory menegotto_pinto;
};

/// Stress [Pa] at the next strain; `strength` (0 ... 1) multiplies f_y and f_u (Eq. 24).
inline double steel_stress(SteelParams const& p, SteelHistory& h, double strain,
                           double strength = 1) noexcept {
  SteelParams const now = reduced(p, strength);
  if (p.law == SteelLaw::menegotto_pinto) return SteelMenegottoPinto{now}(h.menegotto_pinto, strain);
  return SteelKato{now}(h.kato, strain);
}

inline bool is_ruptured(SteelParams const& p, SteelHistory const& h) noexcept {
  return p.law == SteelLaw::menegotto_pinto ? h.menegotto_pinto.ruptured : h.kato.ruptured;
}

} // namespace fissura::laws
