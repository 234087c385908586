#pragma once
#include <cstdint>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

/// Fingerprint of displacements, velocities and joint histories. Each record is hashed with its number in the
/// input and the hashes are added: the same for every layout and number of threads.
std::uint64_t state_hash(model::Model const& m, state::State const& s);

} // namespace fissura::sim
