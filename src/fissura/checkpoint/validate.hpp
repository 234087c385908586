#pragma once
#include "fissura/checkpoint/archive.hpp"
#include "fissura/model/model.hpp"

namespace fissura::checkpoint {

/// Refuses a state that does not fit the model: whatever the step uses as an index lies in its range, lists
/// are in their order. (Lengths are checked as they are read.)
void validate(model::Model const& m, state::State const& s, Loader const& from);

} // namespace fissura::checkpoint
