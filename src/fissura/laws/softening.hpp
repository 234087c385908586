#pragma once
// Softening of a crack: the share z of its strength that a joint keeps at damage D.
//
// Source: Eq. 15 of the founding paper, the fit of Evans and Marathe (1968) that the Y codes use.
// Parameters: a = 0.63, b = 1.8, c = 6, dimensionless constants of the fit. History: none.
// Misprints: none known. The often used range 3 G_f/f_t is not 1/I but 1.159 times too long.
#include <cmath>

namespace fissura::laws {

/// Area under z(D) between 0 and 1: a joint that softens over the range o_r dissipates I f_t o_r [-].
inline constexpr double softening_integral = 0.386307294744;

/// z(D) [-], Eq. 15: 1 at D <= 0 with zero slope, 0 at D >= 1, falling in between.
/// The sixth power is written as products: pow would cost more than all the rest.
inline double softening(double damage) noexcept {
  constexpr double a = 0.63, b = 1.8, c = 6;
  constexpr double peak = (a + b - 1) / (a + b);
  constexpr double rate = (a + c * b) / ((a + b) * (1 - a - b));
  if (damage <= 0) return 1;
  if (damage >= 1) return 0;
  double const left = 1 - damage;
  double const cube = left * left * left;
  return (1 - peak * std::exp(damage * rate)) * (a * left + b * cube * cube);
}

} // namespace fissura::laws
