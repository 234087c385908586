#pragma once

namespace fissura::concrete {

/// Faces whose nodes are nearer than the root of this [m2] have neither turned by 30 degrees nor parted. (A
/// face lower than 0.04 of the edge it turns about could; that is looked at a little late, nothing else.)
constexpr double least_parting(double area) {
  return 0.02 * area;
}

} // namespace fissura::concrete
