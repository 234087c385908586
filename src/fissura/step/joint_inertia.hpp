#pragma once
// How much inertia joints get: as much as brings them down to the step of the bonded body, and no more.
#include "fissura/step/stable_step.hpp"

namespace fissura::step {

/// Chooses Model::points.rate and own inertia, for a model whose points are made, so that its stable step is
/// about that of the same body without joints; returns the stable step that it then has, from its own forces.
StableStep choose_inertia(model::Model& m);

} // namespace fissura::step
