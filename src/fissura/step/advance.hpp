#pragma once
// One time step, term by term as in Eq. (2).
#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"
#include "fissura/step/ledger.hpp"

namespace fissura::step {

/// The state at rest at t = 0 with its first stage begun.
state::State make_state(model::Model const& m);
/// Work arrays of the step, sized once: no allocation after this.
state::Scratch make_scratch(model::Model const& m, state::State const& s);

/// v at n - 1/2, u at n  ->  v at n + 1/2, u at n + 1. With `reading`, also fills in the energy balance at n.
void advance(model::Model const& m, state::State& s, state::Scratch& w, EnergyBalance* reading = nullptr);

} // namespace fissura::step
