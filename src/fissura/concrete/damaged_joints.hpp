#pragma once
#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::concrete {

struct KernelSet;

/// The full law of the damaged joints of one group (state::JointHistories), and of `count` intact ones that
/// leave the undamaged range: evaluates their points, updates their histories and overwrites their forces.
/// Groups may be evaluated at the same time.
void damaged_joints(KernelSet const& kernels, model::Model const& m, state::State& s,
                    state::JointSlots& slots, std::size_t group, int const* fresh, int count);

} // namespace fissura::concrete
