#pragma once
// When a bar joint starts to slip: the first time a face it crosses separates (docs/theory/bars.md,
// "Activation").
#include <span>

#include "fissura/laws/cohesive.hpp"
#include "fissura/mesh/mesh.hpp"
#include "fissura/model/bars.hpp"
#include "fissura/rebar/nodes.hpp"

namespace fissura::rebar {

/// Opening and length of the sliding at the point where the bar crosses the face, from the three node pairs
/// and the current normal of the mid-triangle (sliding_2 = 0) [m].
laws::Separation separation_at(model::FaceCrossing const& face, mesh::SharedFace const& shared,
                               Nodes const& nodes);

/// FaceCrossing::surely_intact of a face with this law [m].
double surely_intact_jump(laws::CohesiveParams const& law);

/// True where opening > o_p or sliding > s_p (for the pressure there) at the crossing: D > 0 in Eq. 19.
bool separates(model::FaceCrossing const& face, mesh::SharedFace const& shared,
               laws::CohesiveParams const& law, Nodes const& nodes);

} // namespace fissura::rebar
