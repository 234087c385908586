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

/// The lines that a group of the mesh consists of, each as its points in the order in which they follow each
/// other. Lines come in the order of their first segments; each starts at the end that comes first in the
/// group, and a closed loop repeats its first point. Throws core::InputError where a line branches.
std::vector<std::vector<Vec3>> ordered_lines(mesh::Mesh const& mesh, mesh::LineGroup const& group,
                                             core::Place const& place);

/// The axes of a bar: its points, or the lines of its curve. Throws core::InputError at bar.place where the
/// curve does not exist.
std::vector<std::vector<Vec3>> axes_of(model::BarSpec const& bar, mesh::Mesh const& mesh);

/// An axis of a bar, moved by shift x spacing. Throws core::InputError at bar.place where it has no length.
Polyline polyline_of(model::BarSpec const& bar, std::vector<Vec3> points, int shift);

} // namespace fissura::rebar
