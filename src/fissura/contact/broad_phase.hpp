#pragma once
// Which boxes meet: a grid of cells as large as the boxes, at a cost linear in their number. The few boxes
// that are much larger than the rest are compared with all.
#include <utility>
#include <vector>

#include "fissura/core/vec3.hpp"

namespace fissura::contact {

struct Box {
  Vec3 low, high;
};
inline bool meet(Box const& a, Box const& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// Pairs (i, j), i < j, of boxes that meet, in ascending order whatever the number of threads.
std::vector<std::pair<int, int>> meeting_boxes(std::vector<Box> const& boxes);

} // namespace fissura::contact
