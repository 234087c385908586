#include "fissura/rebar/trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/core.h>

#include "fissura/geometry/clip.hpp"
#include "fissura/geometry/tet.hpp"

namespace fissura::rebar {

double cell_size(mesh::Mesh const& mesh, int tet) {
  return geometry::regular_edge(geometry::volume(corners(mesh, tet)));
}

namespace {

constexpr double shift_1 = 1e-4,
                 shift_2 = 0.618e-4; // of the local cell size; their ratio avoids common planes
/// A bar that ends on two sides of a body at a small angle leaves it early at one of them, however it is
/// shifted: it is tried again with this share of the shift.
constexpr double less_shift = 0.01;
constexpr double gap_allowed = 1e-3; // of the local cell size: the shifted line may miss an oblique end

/// One straight segment of a bar and the tets that may hold a part of it.
struct Segment {
  Vec3 from, to, normal_1, normal_2;
  double length = 0, size = 0; ///< size: the smallest cell near the segment [m]
  std::vector<int> near;
};

/// A fixed pair of unit normals: the first also normal to the axis that the segment follows least.
void set_normals(Segment& s) {
  Vec3 const r = unit(s.to - s.from);
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(r[i]) < std::abs(r[least]) - 1e-9) least = i;
  Vec3 axis;
  axis[least] = 1;
  s.normal_1 = unit(cross(r, axis));
  s.normal_2 = cross(r, s.normal_1);
}

Segment make_segment(TraceContext const& c, Vec3 from, Vec3 to) {
  Segment s{from, to, {}, {}, norm(to - from), std::numeric_limits<double>::infinity(), {}};
  set_normals(s);
  s.near = c.grid.near_segment(from, to, 0);
  for (int t : s.near) s.size = std::min(s.size, cell_size(c.mesh, t));
  if (s.near.empty()) s.size = 0;
  s.near = c.grid.near_segment(from, to, 2 * shift_1 * s.size);
  return s;
}

struct Attempt {
  std::vector<Piece> pieces; ///< along the segment, from 0 [m]
  double covered = 0;        ///< where the line first leaves the concrete [m]
  bool complete = false;
};

/// Cuts the line, shifted by `shift`, with the tets near it.
Attempt cut(TraceContext const& c, Segment const& s, Vec3 shift) {
  std::vector<Piece> hits;
  for (int t : s.near)
    if (auto const part = geometry::clip_to_tet(corners(c.mesh, t), s.from + shift, s.to + shift))
      if (part->end > part->begin) hits.push_back({t, part->begin * s.length, part->end * s.length});
  std::sort(hits.begin(), hits.end(), [](Piece const& a, Piece const& b) {
    return std::tie(a.begin, a.end, a.tet) < std::tie(b.begin, b.end, b.tet);
  });
  Attempt a;
  double const allowed = std::min(gap_allowed * s.size, 0.01 * s.length);
  for (auto const& hit : hits) {
    if (hit.end <= a.covered) continue;
    if (hit.begin > a.covered + allowed) return a;
    a.pieces.push_back({hit.tet, a.covered, hit.end});
    a.covered = hit.end;
  }
  a.complete = !a.pieces.empty() && a.covered >= s.length - allowed;
  if (a.complete) a.pieces.back().end = s.length;
  return a;
}

std::vector<Piece> trace_segment(TraceContext const& c, Segment const& s, std::string const& name,
                                 core::Place const& place) {
  static constexpr std::array<std::array<double, 2>, 8> ways{{{shift_1, shift_2},
                                                              {-shift_1, -shift_2},
                                                              {-shift_2, shift_1},
                                                              {shift_2, -shift_1},
                                                              {shift_2, shift_1},
                                                              {-shift_2, -shift_1},
                                                              {-shift_1, shift_2},
                                                              {shift_1, -shift_2}}};
  double furthest = 0;
  for (double const share : {1.0, less_shift})
    for (auto const& way : ways) {
      Attempt a = cut(c, s, share * s.size * (way[0] * s.normal_1 + way[1] * s.normal_2));
      if (a.complete) return a.pieces;
      furthest = std::max(furthest, a.covered);
    }
  Vec3 const p = s.from + (furthest / s.length) * (s.to - s.from);
  throw core::InputError(
      place, fmt::format("bar '{}' leaves the concrete at ({:.6g}, {:.6g}, {:.6g}) m; every point "
                         "of a bar must lie in the mesh",
                         name, p.x, p.y, p.z));
}

/// Largest distance [m] by which p lies beyond a face of the tet; negative inside.
double distance_outside(std::array<Vec3, 4> const& x, Vec3 p) {
  double d = -std::numeric_limits<double>::infinity();
  for (auto const& f : mesh::face_corners)
    d = std::max(d, dot(unit(cross(x[f[1]] - x[f[0]], x[f[2]] - x[f[0]])), p - x[f[0]]));
  return d;
}

} // namespace

std::vector<int> faces_between(TraceContext const& c, int a, int b, Vec3 p, std::string const& name,
                               core::Place const& place) {
  struct Step {
    int tet, face, before; // face: the shared face through which the tet was reached from steps[before]
  };
  std::vector<Step> steps{{a, -1, -1}};
  auto reached = [&](int t) {
    return std::any_of(steps.begin(), steps.end(), [&](Step const& s) { return s.tet == t; });
  };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].tet == b) {
      std::vector<int> way;
      for (int k = static_cast<int>(i); k > 0; k = steps[k].before) way.push_back(steps[k].face);
      std::reverse(way.begin(), way.end());
      return way;
    }
    for (int face : c.adjacency.shared_of_tet[steps[i].tet]) {
      if (face < 0) continue;
      auto const& shared = c.adjacency.shared[face];
      int const other = shared.a.tet == steps[i].tet ? shared.b.tet : shared.a.tet;
      if (reached(other)) continue;
      if (other == b || distance_outside(corners(c.mesh, other), p) < 0.01 * cell_size(c.mesh, other))
        steps.push_back({other, face, static_cast<int>(i)});
    }
  }
  throw core::InputError(place,
                         fmt::format("bar '{}' passes at ({:.6g}, {:.6g}, {:.6g}) m between two bodies that "
                                     "touch but share no faces; join their meshes there",
                                     name, p.x, p.y, p.z));
}

namespace {

std::vector<Crossed> crossings(TraceContext const& c, int a, int b, Vec3 p, Vec3 direction,
                               std::string const& name, core::Place const& place) {
  std::vector<Crossed> out;
  for (int face : faces_between(c, a, b, p, name, place)) out.push_back({face, p, direction});
  return out;
}

} // namespace

Chain trace(TraceContext const& c, Polyline const& line, std::string const& name, core::Place const& place) {
  Chain chain;
  auto direction = [&](int k) { return unit(line.points[k + 1] - line.points[k]); };
  for (int k = 0; k < line.segments(); ++k) {
    Segment const segment = make_segment(c, line.points[k], line.points[k + 1]);
    bool first = true;
    for (Piece piece : trace_segment(c, segment, name, place)) {
      piece.begin += line.arc[k];
      piece.end = piece.end == segment.length ? line.arc[k + 1] : piece.end + line.arc[k];
      bool const kink = first && k > 0;
      first = false;
      if (!chain.pieces.empty() && chain.pieces.back().tet == piece.tet) { // a kink inside a tet
        chain.pieces.back().end = piece.end;
        continue;
      }
      Vec3 const r = kink ? unit(direction(k - 1) + direction(k)) : direction(k);
      chain.crossed.push_back(chain.pieces.empty() ? std::vector<Crossed>{}
                                                   : crossings(c, chain.pieces.back().tet, piece.tet,
                                                               line.at(piece.begin), r, name, place));
      chain.pieces.push_back(piece);
    }
  }
  if (line.closed)
    chain.crossed[0] = crossings(c, chain.pieces.back().tet, chain.pieces.front().tet, line.points[0],
                                 unit(direction(line.segments() - 1) + direction(0)), name, place);
  return chain;
}

} // namespace fissura::rebar
