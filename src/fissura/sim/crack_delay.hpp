#pragma once
// How late a crack opens whose joint carries inertia.
//
// While its two sides wait for each other the stress beside them grows on. With the inertia m of a joint per
// area between its sides, and a stress that grows by f_t in the time T, the opening m w'' = f_t t/T reaches
// w = G_f/f_t, where a crack has lost its strength, after (6 m G_f T/f_t^2)^(1/3): the body carries the share
//
//   (6 m G_f/(f_t^2 T^2))^(1/3)
//
// of f_t too much. The estimate is high: a tie that it puts at 0.25 was 0.30 too strong on the coarsest of
// four meshes and 0.07 on the finest (docs/theory/joint_inertia.md).
#include <string>

#include "fissura/model/model.hpp"

namespace fissura::sim {

struct CrackDelay {
  double rise = 0;  ///< T: the time in which loads bring f_t once the body is near it [s]; infinite: none do
  double share = 0; ///< of f_t that cracks come too late
};

/// For joints at the rate r (Points::rate).
CrackDelay crack_delay(model::Model const& m, double rate);

} // namespace fissura::sim
