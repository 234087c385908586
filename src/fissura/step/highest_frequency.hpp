#pragma once
// The highest frequency of a model at rest, from its own forces: the true limit of the time step, where the
// bounds of stable_step.cpp stay up to 40 % below it.
#include "fissura/model/model.hpp"

namespace fissura::step {

struct HighestFrequency {
  double omega_2 = 0; ///< largest eigenvalue of M^-1 K [1/s2]
  double viscous = 0; ///< largest eigenvalue of M^-1 C, C the viscous matrix [1/s]
};

/// How the copies of a point move: by themselves, against their joints and with the joints' inertia, or as
/// one.
enum class Copies { parted, tied };

/// By Lanczos iteration on the model's forces, with bar joints whole and activated, until the eigenvalue is
/// known to 0.2 %; the rest of its error bound is added. Costs some 30 to 100 force evaluations, at most 40
/// on large meshes; twice with bar joints.
HighestFrequency highest_frequency(model::Model const& m, Copies copies = Copies::parted);

} // namespace fissura::step
