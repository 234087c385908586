#pragma once
#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::concrete {

struct KernelSet;

/// The full law of `count` joints that are or may become damaged: evaluates their points, updates their
/// histories and overwrites their forces. They are in ascending order and belong to blocks from `first_block`
/// on, whose batches they take; joints of different blocks may be evaluated at the same time.
void damaged_joints(KernelSet const& kernels, model::Model const& m, state::State& s,
                    state::JointSlots& slots, std::size_t first_block, int const* joints, int count);

} // namespace fissura::concrete
