#pragma once
// The axis of one copy of a bar: an ordered polyline with its arc length.
#include <vector>

#include "fissura/core/vec3.hpp"
#include "fissura/mesh/mesh.hpp"
#include "fissura/model/case.hpp"

namespace fissura::rebar {

struct Polyline {
  std::vector<Vec3> points; ///< [m]; a closed polyline repeats its first point at the end
  std::vector<double> arc;  ///< arc length of each point [m]; arc.back() is the length
  bool closed = false;

  double length() const { return arc.back(); }
  int segments() const { return static_cast<int>(points.size()) - 1; }
  /// The point at arc length s [m], 0 <= s <= length.
  Vec3 at(double s) const;
  /// Index of the segment that holds arc length s.
  int segment_at(double s) const;
};

/// The points of a line group of the mesh in the order in which they follow each other, starting at the end
/// that comes first in the group; a closed loop repeats its first point. Throws core::InputError where the
/// group branches or falls into several lines.
std::vector<Vec3> ordered_points(mesh::Mesh const& mesh, mesh::LineGroup const& group,
                                 core::Place const& place);

/// The axis of copy number `copy` of a bar (its points or its curve, moved by copy x spacing). Throws
/// core::InputError at bar.place where the curve does not exist or the axis has no length.
Polyline polyline_of(model::BarSpec const& bar, mesh::Mesh const& mesh, int copy);

} // namespace fissura::rebar
