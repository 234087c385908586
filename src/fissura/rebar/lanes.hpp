#pragma once
#include "fissura/model/model.hpp"
#include "fissura/state/bar_state.hpp"

namespace fissura::rebar {

/// Fills in the lanes of a scratch: where packs find everything.
void make_bar_lanes(model::Model const& m, state::BarScratch& w);

} // namespace fissura::rebar
