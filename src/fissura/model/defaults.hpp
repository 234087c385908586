#pragma once
// What a case means where it leaves the choice to the program.
#include "fissura/model/case.hpp"

namespace fissura::model {

/// Loads that come as impacts or waves: impactors and planes, initial velocities, absorbing boundaries,
/// strengths that grow with the strain rate. Joints with inertia would answer them late
/// (docs/theory/joint_inertia.md).
bool is_fast(Case const& c);

/// Local damping in the run or in a stage: it acts on the force of each copy of a point, and joint inertia
/// ties their accelerations; a column under 0.7 of it blew up at 0.65 of the stable step.
bool has_local_damping(Case const& c);

/// `[run] joint_inertia`. Automatic: where loading is slow and nothing else is asked of the time step.
bool has_joint_inertia(Case const& c);

/// Steps between two readings of the ledger, at which paths are steered and rest is looked for. Where it is not
/// given: 50, or 10 of the longer steps of joint inertia.
int steps_per_reading(Case const& c);

/// p of the joints of a concrete [Pa]. Where it is not given: 100 E if joints do not set the time step, else
/// 20 E, for the step falls as the root of it.
double joint_penalty(Case const& c, ConcreteSpec const& concrete);

} // namespace fissura::model
