#pragma once
// Strengths that grow with the strain rate (docs/theory/rate_factor.md).
#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::concrete {

/// Takes a sample of the strain rate |D n| on the plane of an undamaged joint, the mean of its two tets, into
/// the moving average, and renews the factor on its strengths (state::strength_factor); keeps the factor of a
/// damaged joint. Does nothing where the strength does not depend on the rate.
void follow_strain_rate(model::Model const& m, state::State& s, int joint, Vec3 normal);

} // namespace fissura::concrete
