#pragma once
// The end of a joint: its faces turn away from each other, slide past each other, and leave their load to
// contact.
#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/least_parting.hpp"

namespace fissura::concrete {

/// A joint whose faces have turned by 60 degrees has broken, also where a point on the hinge between them
/// never opened; what that held is lost.
void break_at_hinge(model::Model const& m, state::State& s, int joint, JointKinematics const& now);

/// The load that a crack-face pair gives up goes to contact, which takes it up as the faces close; what the
/// pair held for it one step ago is lost to friction.
void hand_over(model::Model const& m, state::State& s, int joint, JointKinematics const& now);

} // namespace fissura::concrete
