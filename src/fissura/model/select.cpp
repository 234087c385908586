#include "fissura/model/select.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/core.h>

#include "fissura/core/text.hpp"
#include "fissura/geometry/clip.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/faces.hpp"
#include "fissura/mesh/merge.hpp"

namespace fissura::model {

using Kind = Selector::Kind;
using mesh::Mesh;
using mesh::TetFace;

namespace {

// ---- errors -------------------------------------------------------------------------------------

std::string text(Vec3 p) {
  return fmt::format("({:g}, {:g}, {:g})", p.x, p.y, p.z);
}

std::string describe(Selector const& s) {
  std::string const within = s.tolerance > 0 ? fmt::format(" within {:g} m", s.tolerance) : "";
  switch (s.kind) {
  case Kind::all:
    return "everything";
  case Kind::group:
    return fmt::format("group '{}'", s.group);
  case Kind::plane:
    return fmt::format("plane {} = {:g} m{}", "xyz"[s.axis], s.at, within);
  case Kind::box:
    return fmt::format("box {} to {} m{}", text(s.from), text(s.to), within);
  case Kind::line:
    return fmt::format("line {} to {} m{}", text(s.from), text(s.to), within);
  case Kind::point:
    return fmt::format("point {} m{}", text(s.from), within);
  }
  return "";
}

/// Another axis on which the plane would meet the mesh: axes are easily swapped.
std::string swapped_axis(Mesh const& m, Selector const& s) {
  if (s.kind != Kind::plane) return {};
  for (int axis = 0; axis < 3; ++axis)
    for (Vec3 const p : m.points)
      if (axis != s.axis && std::abs(p[axis] - s.at) <= std::max(s.tolerance, 1e-9))
        return fmt::format("; plane {} = {:g} m has some: are the axes swapped?", "xyz"[axis], s.at);
  return {};
}

/// Structures are neither longer than a few hundred metres nor shorter than a centimetre.
std::string unlikely_size(Vec3 low, Vec3 high) {
  double const longest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  return longest > 300 || longest < 0.01 ? "; is the unit of length right?" : "";
}

[[noreturn]] void refuse_empty(Mesh const& m, Selector const& s, std::string const& what) {
  Vec3 low = m.points.empty() ? Vec3{} : m.points[0], high = low;
  for (Vec3 const p : m.points)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  throw core::InputError(s.place, fmt::format("{} selects no {}; the model reaches from {} to {} m{}{}",
                                              describe(s), what, text(low), text(high), swapped_axis(m, s),
                                              unlikely_size(low, high)));
}

/// Number of insertions, deletions and replacements that turn a into b.
std::size_t edit_distance(std::string const& a, std::string const& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      std::size_t const replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row[b.size()];
}

// ---- groups -------------------------------------------------------------------------------------

/// Indices of the groups a name stands for, by kind; -1 where there is none.
struct Found {
  int volume = -1, surface = -1, curve = -1, point = -1;
};

template <class Groups> int find_name(Groups const& groups, std::string const& name) {
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (groups[i].name == name) return static_cast<int>(i);
  return -1;
}

[[noreturn]] void refuse_unknown(Mesh const& m, Selector const& s) {
  std::vector<std::string> names = m.volume_groups;
  for (auto const& g : m.face_groups) names.push_back(g.name);
  for (auto const& g : m.line_groups) names.push_back(g.name);
  for (auto const& g : m.point_groups) names.push_back(g.name);
  auto const nearest = std::min_element(names.begin(), names.end(), [&](auto const& a, auto const& b) {
    return edit_distance(a, s.group) < edit_distance(b, s.group);
  });
  bool const alike = nearest != names.end() && edit_distance(*nearest, s.group) <= 1 + s.group.size() / 3;
  throw core::InputError(s.place, fmt::format("the mesh has no group '{}'{}; its groups: {}", s.group,
                                              alike ? fmt::format(" (did you mean '{}'?)", *nearest) : "",
                                              core::joined(names, ", ")));
}

Found find_group(Mesh const& m, Selector const& s) {
  Found f;
  auto const volume = std::find(m.volume_groups.begin(), m.volume_groups.end(), s.group);
  if (volume != m.volume_groups.end()) f.volume = static_cast<int>(volume - m.volume_groups.begin());
  f.surface = find_name(m.face_groups, s.group);
  f.curve = find_name(m.line_groups, s.group);
  f.point = find_name(m.point_groups, s.group);
  if (f.volume < 0 && f.surface < 0 && f.curve < 0 && f.point < 0) refuse_unknown(m, s);
  return f;
}

[[noreturn]] void refuse_kind(Selector const& s, std::string const& what) {
  throw core::InputError(s.place,
                         fmt::format("group '{}' has no {}: name a surface or volume group, or use a plane "
                                     "or a box",
                                     s.group, what));
}

std::vector<char> points_of_group(Mesh const& m, Selector const& s) {
  std::vector<char> chosen(m.points.size(), 0);
  auto const choose = [&](auto const& items) {
    for (int p : items) chosen[p] = 1;
  };
  Found const f = find_group(m, s);
  if (f.volume >= 0) {
    for (std::size_t t = 0; t < m.tets.size(); ++t)
      if (m.tet_group[t] == f.volume) choose(m.tets[t]);
  } else if (f.surface >= 0) {
    for (auto const& t : m.face_groups[f.surface].triangles) choose(t);
  } else if (f.curve >= 0) {
    for (auto const& l : m.line_groups[f.curve].segments) choose(l);
  } else {
    choose(m.point_groups[f.point].points);
  }
  return chosen;
}

// ---- places -------------------------------------------------------------------------------------

/// Indices i < count for which candidate(i) holds and the place at(i) is selected (by geometry).
template <class Candidate, class At>
std::vector<int> select_places(Mesh const& m, Selector const& s, std::size_t count, Candidate candidate,
                               At at) {
  std::vector<int> chosen;
  if (s.kind == Kind::point && s.tolerance <= 0) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < static_cast<int>(count); ++i) {
      if (!candidate(i)) continue;
      double const distance = core::norm(at(i) - s.from);
      if (distance < least) least = distance, chosen = {i};
    }
    return chosen;
  }
  double const tolerance = default_tolerance(m);
  for (int i = 0; i < static_cast<int>(count); ++i)
    if (candidate(i) && inside(s, at(i), tolerance)) chosen.push_back(i);
  return chosen;
}

bool always(int) {
  return true;
}

std::vector<int> non_empty(std::vector<int> chosen, Mesh const& m, Selector const& s,
                           std::string const& what) {
  if (chosen.empty()) refuse_empty(m, s, what);
  return chosen;
}

/// The boundary faces that are the triangles of a surface group.
std::vector<TetFace> faces_of_surface(Mesh const& m, mesh::Adjacency const& adjacency,
                                      mesh::FaceGroup const& group, Selector const& s) {
  mesh::FaceFinder const finder(m);
  std::vector<TetFace> faces;
  std::size_t inner = 0;
  for (auto const& t : group.triangles) {
    auto const sides = finder.find(t);
    if (sides.size() == 1 && adjacency.shared_of_tet[sides[0].tet][sides[0].face] < 0)
      faces.push_back(sides[0]);
    else
      ++inner;
  }
  if (inner > 0)
    throw core::InputError(s.place,
                           fmt::format("{} of the {} triangles of group '{}' are not on the boundary of the "
                                       "body; faces to load must be outer ones",
                                       inner, group.triangles.size(), s.group));
  std::sort(faces.begin(), faces.end(),
            [](TetFace a, TetFace b) { return a.tet != b.tet ? a.tet < b.tet : a.face < b.face; });
  return faces;
}

/// Boundary faces by the group's tets or triangles.
std::vector<TetFace> faces_of_group(Mesh const& m, mesh::Adjacency const& adjacency, Selector const& s) {
  Found const f = find_group(m, s);
  if (f.volume < 0 && f.surface < 0) refuse_kind(s, "faces");
  if (f.volume < 0) return faces_of_surface(m, adjacency, m.face_groups[f.surface], s);
  std::vector<TetFace> faces;
  for (TetFace const b : adjacency.boundary)
    if (m.tet_group[b.tet] == f.volume) faces.push_back(b);
  return faces;
}

std::vector<int> shared_of_group(Mesh const& m, mesh::Adjacency const& adjacency, Selector const& s) {
  Found const f = find_group(m, s);
  if (f.volume < 0 && f.surface < 0) refuse_kind(s, "joints");
  std::vector<int> chosen;
  if (f.volume >= 0) {
    for (int i = 0; i < static_cast<int>(adjacency.shared.size()); ++i) {
      auto const& shared = adjacency.shared[i];
      if (m.tet_group[shared.a.tet] == f.volume || m.tet_group[shared.b.tet] == f.volume) chosen.push_back(i);
    }
    return chosen;
  }
  mesh::FaceFinder const finder(m);
  for (auto const& t : m.face_groups[f.surface].triangles)
    for (TetFace const side : finder.find(t))
      if (int const shared = adjacency.shared_of_tet[side.tet][side.face]; shared >= 0)
        chosen.push_back(shared);
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

} // namespace

double default_tolerance(Mesh const& mesh) {
  return 1e-6 * mesh::largest_extent(mesh.points);
}

bool inside(Selector const& s, Vec3 x, double fallback_tolerance) {
  double const tolerance = s.tolerance > 0 ? s.tolerance : fallback_tolerance;
  switch (s.kind) {
  case Kind::all:
    return true;
  case Kind::group:
    return false;
  case Kind::plane:
    return std::abs(x[s.axis] - s.at) <= tolerance;
  case Kind::line:
    return geometry::distance_to_segment(x, s.from, s.to) <= tolerance;
  case Kind::point:
    return core::norm(x - s.from) <= tolerance;
  case Kind::box:
    break;
  }
  for (int k = 0; k < 3; ++k)
    if (x[k] < std::min(s.from[k], s.to[k]) - tolerance || x[k] > std::max(s.from[k], s.to[k]) + tolerance)
      return false;
  return true;
}

std::vector<int> select_points(Mesh const& m, Selector const& s) {
  auto const used = mesh::points_of_tets(m);
  std::vector<int> chosen;
  if (s.kind == Kind::group) {
    auto const in_group = points_of_group(m, s);
    for (int p = 0; p < static_cast<int>(used.size()); ++p)
      if (used[p] && in_group[p]) chosen.push_back(p);
  } else {
    chosen = select_places(
        m, s, m.points.size(), [&](int p) { return used[p] != 0; }, [&](int p) { return m.points[p]; });
  }
  return non_empty(std::move(chosen), m, s, "point of a tet");
}

std::vector<TetFace> select_boundary_faces(Mesh const& m, mesh::Adjacency const& adjacency,
                                           Selector const& s) {
  std::vector<TetFace> faces;
  if (s.kind == Kind::group) {
    faces = faces_of_group(m, adjacency, s);
  } else {
    double const tolerance = default_tolerance(m);
    for (TetFace const f : adjacency.boundary) {
      auto const x = mesh::face_triangle(m, f);
      if (std::all_of(x.begin(), x.end(), [&](Vec3 p) { return inside(s, p, tolerance); }))
        faces.push_back(f);
    }
  }
  if (faces.empty()) refuse_empty(m, s, "boundary face");
  return faces;
}

std::vector<int> select_tets(Mesh const& m, Selector const& s) {
  if (s.kind != Kind::group) {
    auto const centroid = [&](int t) { return geometry::centroid(mesh::corners(m, t)); };
    return non_empty(select_places(m, s, m.tets.size(), always, centroid), m, s, "tet");
  }
  Found const f = find_group(m, s);
  if (f.volume < 0)
    throw core::InputError(s.place, fmt::format("group '{}' has no tets: name a volume group", s.group));
  std::vector<int> chosen;
  for (int t = 0; t < static_cast<int>(m.tets.size()); ++t)
    if (m.tet_group[t] == f.volume) chosen.push_back(t);
  return non_empty(std::move(chosen), m, s, "tet");
}

std::vector<int> select_shared_faces(Mesh const& m, mesh::Adjacency const& adjacency, Selector const& s) {
  if (s.kind == Kind::group) return non_empty(shared_of_group(m, adjacency, s), m, s, "joint");
  auto const centroid = [&](int i) {
    return geometry::centroid(mesh::face_triangle(m, adjacency.shared[i].a));
  };
  return non_empty(select_places(m, s, adjacency.shared.size(), always, centroid), m, s, "joint");
}

} // namespace fissura::model
