#pragma once
// From the reinforcement as an engineer writes it (cover, layers, stirrups) to bars.
#include <string>
#include <vector>

#include "fissura/model/case.hpp"

namespace fissura::model {

/// Something about a cage that cannot be built: the key it concerns, and what to do.
struct CageFault {
  std::string key, message;
};

/// The axis along the member: as given, or its longest side (the first of equal ones).
int axis_of(CageSpec const& cage);
/// The axis that points to the top of a beam; a column has its two section axes in the order x, y, z.
int up_of(CageSpec const& cage);

/// The bars of a cage, each layer one BarSpec with `count` copies, in this order:
/// beam    NAME_bottom, NAME_bottom_2, ..., NAME_top, NAME_top_2, ..., NAME_side_1, NAME_side_2
/// column  NAME_row_1, NAME_row_2 (with the corner bars), NAME_side_1, NAME_side_2
/// both    NAME_stirrups
/// Stirrups are closed rectangles with sharp corners, their axes at cover + d_s/2; longitudinal bars lie
/// inside them and touch them. Whatever does not fit is added to `faults`, and no bars are made of it.
std::vector<BarSpec> make_bars(CageSpec const& cage, std::vector<CageFault>& faults);

} // namespace fissura::model
