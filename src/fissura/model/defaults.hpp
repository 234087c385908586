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

/// Whether joints may carry inertia: `[run] joint_inertia` asks for it, or leaves it to the program
/// (`automatic`) and nothing in the case speaks against it. What the loads' speed says is seen with the model
/// (sim/crack_delay.hpp).
bool may_have_joint_inertia(Case const& c);

constexpr double default_penalty = 20; ///< times E

/// p of the joints of a concrete [Pa].
double joint_penalty(ConcreteSpec const& concrete);

} // namespace fissura::model
