#pragma once
// The largest time step of the central differences that is safe for a model.
#include <limits>
#include <string>
#include <vector>

#include "fissura/model/model.hpp"

namespace fissura::step {

struct StableStep {
  double dt = 0;       ///< 2/omega with viscosity [s], without the safety factor
  std::string limiter; ///< what governs: which tet, and whether its own, joint or bar-joint stiffness leads
  double bound = 0;    ///< the bound alone [s]
  int tet = -1;        ///< the tet that governs
  double omega = 0;    ///< the highest frequency, or its bound [rad/s]
  /// With joint inertia: what every tet can take alone, should it come loose [s].
  double of_loose_tets = std::numeric_limits<double>::infinity();
};

/// The limit of the model's own forces at rest (step/highest_frequency.hpp), or where that is lower (it never
/// should be) the bound over tets, joints, bar joints and viscosity: the joints' and bars'
/// stiffness is replaced by its Gershgorin diagonal 2/m_a [sum p A/(3h) + sum of bar stiffness]
/// (rebar/bar_stiffness.cpp), which leaves one block per tet; the frequency of a block is at most that of the
/// tet alone plus its largest diagonal entry. Rigorous for small displacements.
StableStep stable_step(model::Model const& m);

/// The largest step at the frequency omega [rad/s] with the viscous eigenvalue c [1/s] over mass; viscous
/// forces lag half a step [s].
double largest_step(double omega, double c);

/// Selective mass scaling: per tet, the factor on its mass that lifts the bound of its step to `dt` [s]; 1
/// where it is there already. (With viscosity the factor is a bound.)
std::vector<double> mass_factors(model::Model const& m, double dt);

} // namespace fissura::step
