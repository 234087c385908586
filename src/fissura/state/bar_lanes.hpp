#pragma once
// Where packs find the data of eight bar elements or bar joints: all as starts in doubles, found once. Behind
// the last item its lanes repeat it.
#include <array>

namespace fissura::state {

using BarLanes = std::array<int, 8>;

struct alignas(64) ElementLanes {
  BarLanes index;   ///< of the element
  BarLanes element; ///< in Bars::elements
  BarLanes host;    ///< in nodal arrays: corner 0 of its tet
  BarLanes now;     ///< in BarScratch::element
};

/// One face that each of eight bar joints crosses.
struct alignas(64) CrossingLanes {
  std::array<BarLanes, 3> node_a, node_b; ///< in nodal arrays: the corners of its two sides
  std::array<std::array<double, 8>, 3> weights;
  std::array<double, 8> surely_intact; ///< FaceCrossing::surely_intact, squared [m2]
};

struct alignas(64) BarJointLanes {
  BarLanes joint;                     ///< in Bars::joints
  BarLanes host_a, host_b;            ///< in nodal arrays: corner 0 of tet_a and tet_b
  BarLanes frame_0, frame_1;          ///< in nodal arrays: the ends of frame_edge
  BarLanes element_a, element_b, now; ///< in BarScratch::element, ::joint
  int crossings_begin, crossings_end; ///< BarScratch::crossing_lanes[begin .. end)
};

} // namespace fissura::state
