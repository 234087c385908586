#include "fissura/rebar/polyline.hpp"

#include <algorithm>
#include <map>

#include <fmt/core.h>

#include "fissura/core/text.hpp"
#include "fissura/mesh/groups.hpp"

namespace fissura::rebar {

int Polyline::segment_at(double s) const {
  auto const it = std::upper_bound(arc.begin() + 1, arc.end() - 1, s);
  return static_cast<int>(it - arc.begin()) - 1;
}

Vec3 Polyline::at(double s) const {
  int const k = segment_at(s);
  double const t = (s - arc[k]) / (arc[k + 1] - arc[k]);
  return (1 - t) * points[k] + t * points[k + 1];
}

namespace {

using Around = std::map<int, std::vector<int>>; ///< point -> the segments that touch it

Around segments_at_points(mesh::LineGroup const& group, mesh::Mesh const& mesh, core::Place const& place) {
  Around at;
  for (int s = 0; s < static_cast<int>(group.segments.size()); ++s)
    for (int p : group.segments[s]) at[p].push_back(s);
  for (auto const& [p, segments] : at)
    if (segments.size() > 2)
      throw core::InputError(
          place,
          fmt::format("curve '{}' branches at ({:g}, {:g}, {:g}) m: nothing says which of the {} lines "
                      "there make one bar; put bars that meet into sets (or physical curves) of their "
                      "own, or give them nodes of their own",
                      group.name, mesh.points[p].x, mesh.points[p].y, mesh.points[p].z, segments.size()));
  return at;
}

/// The lines of a group, one after the other.
class Lines {
 public:
  Lines(mesh::Mesh const& mesh_, mesh::LineGroup const& group_, Around const& at_)
      : mesh(mesh_), group(group_), at(at_), used(group_.segments.size(), 0) {}

  std::vector<std::vector<Vec3>> all() {
    std::vector<std::vector<Vec3>> lines;
    for (std::size_t s = 0; s < group.segments.size(); ++s)
      if (!used[s]) lines.push_back(line_from(starting_point(static_cast<int>(s))));
    return lines;
  }

 private:
  /// The segment at p that is not yet used, or -1.
  int next_at(int p) const {
    for (int const s : at.at(p))
      if (!used[s]) return s;
    return -1;
  }
  int other_end(int s, int p) const {
    auto const& segment = group.segments[s];
    return segment[0] == p ? segment[1] : segment[0];
  }
  /// Of the two ends of the line through segment s the one whose segment comes first in the group; where the
  /// line is closed, the first point of s.
  int starting_point(int s) const {
    auto const walk = [&](int from, int towards) {
      int segment = s, p = towards;
      while (at.at(p).size() == 2) {
        auto const& around = at.at(p);
        segment = around[0] == segment ? around[1] : around[0];
        if (segment == s) return std::pair{-1, from}; // round
        p = other_end(segment, p);
      }
      return std::pair{segment, p};
    };
    auto const [first, second] = group.segments[s];
    auto const a = walk(second, first), b = walk(first, second);
    if (a.first < 0) return first;
    if (a.first != b.first) return a.first < b.first ? a.second : b.second;
    return first; // one segment is the whole line
  }
  std::vector<Vec3> line_from(int p) {
    std::vector<Vec3> points{mesh.points[p]};
    for (int s = next_at(p); s >= 0; s = next_at(p)) {
      used[s] = 1;
      p = other_end(s, p);
      points.push_back(mesh.points[p]);
    }
    return points;
  }

  mesh::Mesh const& mesh;
  mesh::LineGroup const& group;
  Around const& at;
  std::vector<char> used;
};

} // namespace

std::vector<std::vector<Vec3>> ordered_lines(mesh::Mesh const& mesh, mesh::LineGroup const& group,
                                             core::Place const& place) {
  if (group.segments.empty())
    throw core::InputError(place, fmt::format("curve '{}' has no segments", group.name));
  auto const at = segments_at_points(group, mesh, place);
  return Lines(mesh, group, at).all();
}

std::vector<std::vector<Vec3>> axes_of(model::BarSpec const& bar, mesh::Mesh const& mesh) {
  if (bar.curve.empty()) return {bar.points};
  if (!mesh::groups_named(mesh, 1, bar.curve, bar.place).empty())
    return ordered_lines(mesh, mesh::curve_named(mesh, bar.curve, bar.place), bar.place);
  auto const known = core::joined(mesh::names_of_groups(mesh, 1), ", ");
  throw core::InputError(bar.place, fmt::format("bar '{}': the mesh has no curve '{}' (it has: {})", bar.name,
                                                bar.curve, known.empty() ? "none" : known));
}

Polyline polyline_of(model::BarSpec const& bar, std::vector<Vec3> points, int shift) {
  Polyline line;
  if (bar.closed && !points.empty()) points.push_back(points.front());
  Vec3 const offset = static_cast<double>(shift) * bar.spacing;
  for (Vec3 p : points) {
    p += offset;
    if (!line.points.empty() && norm(p - line.points.back()) == 0)
      continue; // a repeated point adds no length
    line.arc.push_back(line.points.empty() ? 0 : line.arc.back() + norm(p - line.points.back()));
    line.points.push_back(p);
  }
  if (line.points.size() < 2)
    throw core::InputError(bar.place,
                           fmt::format("bar '{}' has no length: it needs two different points", bar.name));
  line.closed = line.points.size() > 2 && line.points.front() == line.points.back();
  return line;
}

} // namespace fissura::rebar
