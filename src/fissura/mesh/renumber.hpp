#pragma once
// A numbering in which neighbours in space are neighbours in memory.
#include <array>
#include <cstdint>

#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// Bits per axis of a Hilbert index.
inline constexpr int hilbert_bits = 20;

/// Place of a cell of a cubic grid (0 <= coordinate < 2^bits) along the Hilbert curve through that grid:
/// consecutive places are neighbouring cells. After C. Hamilton and A. Rau-Chaplin, Compact Hilbert indices,
/// 2008.
std::uint64_t hilbert_index(std::array<std::uint32_t, 3> cell, int bits = hilbert_bits);

/// Orders the tets along a Hilbert curve through their centroids (ties by their former order) and the points
/// by first use; points of groups that no tet uses come last, points that nothing uses are dropped. Groups
/// and input_id follow. The same input always gives the same numbering.
void renumber(Mesh& mesh);

/// Drops the points that neither a tet nor a group uses; keeps the order of the others.
void drop_unused_points(Mesh& mesh);

} // namespace fissura::mesh
