#pragma once
// Removes the slivers that a bar cuts off where it runs near an edge, a face or a corner of the mesh.
#include "fissura/rebar/trace.hpp"

namespace fissura::rebar {

inline constexpr double shortest_piece = 0.05; ///< of the local cell size

/// Drops every piece shorter than 0.05 of its cell size, the shortest first; its neighbours are extended to
/// its middle (at an end of the bar the only neighbour takes all), and the faces on both sides of it end up
/// between them. A face crossed forth and back is crossed no more. The whole length stays covered; one piece
/// always stays. Without this rule a bar along an edge would get joints many times too stiff.
Chain merge_short(mesh::Mesh const& mesh, Chain const& chain);

/// Moves the border between two pieces to a kink of the polyline that lies within 0.05 of the cell size of
/// it, where both pieces stay longer than that: otherwise the kink would cut off a sliver.
void snap_to_kinks(mesh::Mesh const& mesh, Polyline const& line, Chain& chain);

} // namespace fissura::rebar
