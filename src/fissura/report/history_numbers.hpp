#pragma once
#include <string>

#include "fissura/report/blob.hpp"
#include "fissura/report/run_folder.hpp"

namespace fissura::report {

/// Adds the curves: meta[name] = {rows, columns: [{name, unit}]} and an array "name/<i>" per column. More
/// than 6000 rows are thinned evenly; rows in which a count leaves zero or a column has an extreme value
/// stay.
void add_history(Blob& blob, std::string const& name, History const& history);

/// What the deck says about gauges, bars and steels, for labels and marks: names, kinds, yield strengths.
/// Empty lists where the deck cannot be read any more (its mesh file has gone, say).
output::Json describe_deck(RunFolder const& run);

} // namespace fissura::report
