#pragma once
// Cages become bars: before the checks, so that names refer to them, and into Case::bars only after the last
// check, since the reader knows records by their place in memory.
#include "fissura/deck/reader.hpp"

namespace fissura::deck {

Section cage_section();

/// Fills in CageSpec::made; reports what does not fit.
void make_cages(Reader& reader);
/// Moves CageSpec::made to the end of Case::bars.
void hand_over_cages(model::Case& the_case);

} // namespace fissura::deck
