#pragma once
// Points that coincide.
#include <span>
#include <vector>

#include "fissura/core/vec3.hpp"

namespace fissura::mesh {

/// Largest side [m] of the box around the points; 0 for none.
double largest_extent(std::span<Vec3 const> points);

/// For each point the smallest index of a point within `tolerance` [m] of it (its own where it is the first).
std::vector<int> find_coincident(std::span<Vec3 const> points, double tolerance);

} // namespace fissura::mesh
