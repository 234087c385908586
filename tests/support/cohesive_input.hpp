#pragma once
// A concrete for tests of the cohesive law.
#include "fissura/laws/cohesive.hpp"

namespace fissura::support {

inline laws::CohesiveInput cohesive_input(bool mohr_coulomb,
                                          laws::CohesiveLaw law = laws::CohesiveLaw::energy_consistent) {
  laws::CohesiveInput in;
  in.p = 3e12, in.h = 0.02, in.f_t = 3e6, in.G_f = 100, in.G_s = 300;
  in.mohr_coulomb = mohr_coulomb, in.f_s = 6e6, in.cohesion = 6e6, in.friction_angle = 0.6283, in.law = law;
  return in;
}

} // namespace fissura::support
