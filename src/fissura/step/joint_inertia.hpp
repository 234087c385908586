#pragma once
// How much inertia joints get: as much as brings them down to the step of the bonded body, and no more.
#include "fissura/step/stable_step.hpp"

namespace fissura::step {

/// omega^2 of the body with its points tied [1/s2], and the lowest r that joints must not exceed with the
/// step of that body: what Model::points.rate is to become.
struct TiedBody {
  double omega_2 = 0, rate = 0;
};
TiedBody tied_body(model::Model const& m);

/// Chooses Model::points.rate and own inertia, for a model whose points are made, so that its stable step is
/// about that of the same body without joints; returns the stable step that it then has, from its own forces.
StableStep choose_inertia(model::Model& m, TiedBody const& tied);

/// Inertia that a joint puts between its two sides, per area [kg/m2], at the rate r.
double inertia_of_joint(model::Model const& m, std::size_t joint, double rate);

} // namespace fissura::step
