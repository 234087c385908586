#include "fissura/mesh/quality.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include <fmt/core.h>

#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/overlap.hpp"

namespace fissura::mesh {

namespace {

NamedTet name(Mesh const& m, int tet) {
  return {tet, m.input_id.empty() ? tet : m.input_id[tet], geometry::centroid(corners(m, tet))};
}

std::string text(NamedTet const& t) {
  return fmt::format("tet {} at ({:.6g}, {:.6g}, {:.6g}) m", t.input_id, t.centroid.x, t.centroid.y,
                     t.centroid.z);
}

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

/// Volumes, altitudes and angles.
void measure_shapes(Mesh const& m, Quality& q) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  q.min_volume = q.smallest_altitude = q.smallest_angle = infinite;
  int lowest = 0, sharpest = 0;
  for (int t = 0; t < static_cast<int>(m.tets.size()); ++t) {
    auto const x = corners(m, t);
    double const v = geometry::volume(x);
    double const altitude = geometry::smallest_altitude(x), angle = geometry::smallest_dihedral_angle(x);
    q.volume += v;
    q.min_volume = std::min(q.min_volume, v);
    q.max_volume = std::max(q.max_volume, v);
    if (altitude < q.smallest_altitude) q.smallest_altitude = altitude, lowest = t;
    if (angle < q.smallest_angle) q.smallest_angle = angle, sharpest = t;
    q.slivers += angle < sliver_angle || altitude < sliver_ratio * geometry::longest_edge(x);
  }
  q.smallest_altitude_tet = name(m, lowest);
  q.smallest_angle_tet = name(m, sharpest);
  q.mean_volume = q.volume / static_cast<double>(q.tets);
  q.mean_h = geometry::regular_edge(q.mean_volume);
  q.min_h = geometry::regular_edge(q.min_volume);
  q.max_h = geometry::regular_edge(q.max_volume);
}

/// The box around the mesh and the elements along its edges.
void measure_extents(Mesh const& m, Quality& q) {
  q.low = q.high = m.points[m.tets[0][0]];
  Vec3 sum;
  for (int t = 0; t < static_cast<int>(m.tets.size()); ++t) {
    auto const x = corners(m, t);
    for (int k = 0; k < 3; ++k) {
      auto const [low, high] = std::minmax({x[0][k], x[1][k], x[2][k], x[3][k]});
      q.low[k] = std::min(q.low[k], low);
      q.high[k] = std::max(q.high[k], high);
      sum[k] += high - low;
    }
  }
  for (int k = 0; k < 3; ++k)
    q.elements_over[k] = (q.high[k] - q.low[k]) * static_cast<double>(q.tets) / sum[k];
}

} // namespace

Quality measure_quality(Mesh const& mesh, Adjacency const& adjacency) {
  Quality q;
  q.tets = static_cast<long>(mesh.tets.size());
  if (q.tets == 0) return q;
  measure_shapes(mesh, q);
  measure_extents(mesh, q);
  for (auto const& o : find_overlaps(mesh, adjacency)) {
    if (!o.coincident) continue;
    if (q.open_interfaces++ == 0) q.open_interface_at = o.place;
  }
  return q;
}

std::vector<std::string> quality_warnings(Quality const& q) {
  std::vector<std::string> warnings;
  if (q.slivers > 0)
    warnings.push_back(
        fmt::format("{} of {} tets are slivers (a dihedral angle below {:.0f} degrees or an altitude "
                    "below {:g} of the longest edge); the sharpest has {:.2g} degrees: {}",
                    q.slivers, q.tets, degrees(sliver_angle), sliver_ratio, degrees(q.smallest_angle),
                    text(q.smallest_angle_tet)));
  if (q.smallest_altitude < 0.1 * q.mean_h)
    warnings.push_back(fmt::format(
        "the smallest altitude, {:.3g} m, is {:.2g} of the mean element size {:.3g} m and "
        "will limit the time step: {}",
        q.smallest_altitude, q.smallest_altitude / q.mean_h, q.mean_h, text(q.smallest_altitude_tet)));
  for (int k = 0; k < 3; ++k)
    if (q.elements_over[k] < 3.5)
      warnings.push_back(
          fmt::format("about {:.1f} elements over the extent along {} ({:.4g} m): bending across it "
                      "is poorly resolved below 4",
                      q.elements_over[k], "xyz"[k], q.high[k] - q.low[k]));
  if (q.open_interfaces > 0)
    warnings.push_back(
        fmt::format("{} pairs of boundary faces coincide without sharing points, first at ({:.6g}, "
                    "{:.6g}, {:.6g}) m: the mesh is open there and carries no tension",
                    q.open_interfaces, q.open_interface_at.x, q.open_interface_at.y, q.open_interface_at.z));
  return warnings;
}

} // namespace fissura::mesh
