#pragma once
// The columns that history.csv has of the program's own, beside those of the gauges.
#include <vector>

#include "fissura/model/model.hpp"
#include "fissura/output/csv.hpp"

namespace fissura::sim {

/// Reactions, energies and counts, in this order; with a pace also the time of the loads and the pace.
std::vector<output::Column> own_columns(model::Model const& m);

/// Throws core::InputError at the place of a gauge whose name is that of such a column, or of the time: a
/// plot would draw one of the two.
void check_gauge_names(model::Model const& m);

} // namespace fissura::sim
