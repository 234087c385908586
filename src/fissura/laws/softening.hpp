#pragma once
// Softening of a crack: the share z of its strength that a joint keeps at damage D.
//
// Source: Eq. 15 of the founding paper, the fit of Evans and Marathe (1968) that the Y codes use.
// Parameters: a = 0.63, b = 1.8, c = 6, dimensionless constants of the fit. History: none.
// Misprints: none known. The often used range 3 G_f/f_t is not 1/I but 1.159 times too long.
#include "fissura/core/pack.hpp"

namespace fissura::laws {

/// Area under z(D) between 0 and 1: a joint that softens over the range o_r dissipates I f_t o_r [-].
inline constexpr double softening_integral = 0.386307294744;

inline namespace FISSURA_ISA {

/// exp(x) for -3.3 <= x <= 0, to 2e-15: eight times the series of exp(x/8). The library's exp knows no packs.
template <class V> inline V exp_of_small_negative(V x) {
  V const t = V(0.125) * x;
  V sum(1.0);
  for (int n = 13; n > 0; --n) sum = V(1.0) + V(1.0 / n) * t * sum;
  V const twice = sum * sum, four = twice * twice;
  return four * four;
}

/// z(D) [-], Eq. 15: 1 at D <= 0 with zero slope, 0 at D >= 1, falling in between.
/// The sixth power is written as products: pow would cost more than all the rest.
template <class V> inline V softening(V damage) noexcept {
  constexpr double a = 0.63, b = 1.8, c = 6;
  constexpr double peak = (a + b - 1) / (a + b);
  constexpr double rate = (a + c * b) / ((a + b) * (1 - a - b));
  V const zero(0.0), one(1.0);
  V const d = core::smaller(core::larger(damage, zero), one);
  V const left = one - d;
  V const cube = left * left * left;
  V const z = (one - V(peak) * exp_of_small_negative(V(d * V(rate)))) * (V(a) * left + V(b) * cube * cube);
  return core::choose(d > zero, z, one);
}

} // namespace FISSURA_ISA
} // namespace fissura::laws
