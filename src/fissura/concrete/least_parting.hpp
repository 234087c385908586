#pragma once

namespace fissura::concrete {

/// Faces whose nodes are nearer than the root of this [m2] have neither turned by 30 degrees nor parted.
constexpr double least_parting(double area) {
  return 0.02 * area;
}

} // namespace fissura::concrete
