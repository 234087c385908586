#pragma once
// Which faces are near a rigid body.
#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::contact {

/// Renews RigidScratch::faces once anything may have moved further towards a body than the skin, or a face
/// near one has come free. What is listed changes no result: only faces that touch act, and they are all
/// listed.
void refresh_rigid_faces(model::Model const& m, state::State& s, state::Scratch& w);

} // namespace fissura::contact
