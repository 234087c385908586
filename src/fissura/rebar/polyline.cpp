#include "fissura/rebar/polyline.hpp"

#include <algorithm>
#include <map>

#include <fmt/core.h>

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

/// Point -> the segments that touch it.
std::map<int, std::vector<int>> segments_at_points(mesh::LineGroup const& group) {
  std::map<int, std::vector<int>> at;
  for (int s = 0; s < static_cast<int>(group.segments.size()); ++s)
    for (int p : group.segments[s]) at[p].push_back(s);
  return at;
}

/// The end of the line that comes first in the group; the first point where the line is closed.
int starting_point(mesh::LineGroup const& group, std::map<int, std::vector<int>> const& at) {
  for (auto const& s : group.segments)
    for (int p : s)
      if (at.at(p).size() == 1) return p;
  return group.segments.front()[0];
}

} // namespace

std::vector<Vec3> ordered_points(mesh::Mesh const& mesh, mesh::LineGroup const& group,
                                 core::Place const& place) {
  if (group.segments.empty())
    throw core::InputError(place, fmt::format("curve '{}' has no segments", group.name));
  auto const at = segments_at_points(group);
  for (auto const& [p, segments] : at)
    if (segments.size() > 2)
      throw core::InputError(place,
                             fmt::format("curve '{}' branches at ({:g}, {:g}, {:g}) m; a bar needs one line",
                                         group.name, mesh.points[p].x, mesh.points[p].y, mesh.points[p].z));
  std::vector<char> used(group.segments.size(), 0);
  std::vector<Vec3> points;
  int p = starting_point(group, at);
  points.push_back(mesh.points[p]);
  for (std::size_t step = 0; step < group.segments.size(); ++step) {
    auto const& around = at.at(p);
    auto const next = std::find_if(around.begin(), around.end(), [&](int s) { return !used[s]; });
    if (next == around.end())
      throw core::InputError(
          place, fmt::format("curve '{}' falls into several lines; a bar needs one line", group.name));
    used[*next] = 1;
    auto const& s = group.segments[*next];
    p = s[0] == p ? s[1] : s[0];
    points.push_back(mesh.points[p]);
  }
  return points;
}

namespace {

std::vector<Vec3> axis_points(model::BarSpec const& bar, mesh::Mesh const& mesh) {
  if (bar.curve.empty()) return bar.points;
  for (auto const& group : mesh.line_groups)
    if (group.name == bar.curve) return ordered_points(mesh, group, bar.place);
  std::string known;
  for (auto const& group : mesh.line_groups) known += (known.empty() ? "" : ", ") + group.name;
  throw core::InputError(bar.place, fmt::format("bar '{}': the mesh has no curve '{}' (it has: {})", bar.name,
                                                bar.curve, known.empty() ? "none" : known));
}

} // namespace

Polyline polyline_of(model::BarSpec const& bar, mesh::Mesh const& mesh, int copy) {
  Polyline line;
  auto points = axis_points(bar, mesh);
  if (bar.closed && !points.empty()) points.push_back(points.front());
  Vec3 const offset = static_cast<double>(copy) * bar.spacing;
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
