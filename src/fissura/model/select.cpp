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
#include "fissura/mesh/groups.hpp"
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

/// What a name stands for, by kind: indices of groups, and tets for the volumes.
struct Found {
  std::vector<int> tets, surfaces, curves, points;
  bool none() const { return tets.empty() && surfaces.empty() && curves.empty() && points.empty(); }
};

[[noreturn]] void refuse_unknown(Mesh const& m, Selector const& s) {
  std::vector<std::string> names;
  for (int const dimension : {3, 2, 1, 0})
    for (auto& name : mesh::names_of_groups(m, dimension)) names.push_back(std::move(name));
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
  f.tets = mesh::tets_named(m, s.group, s.place);
  f.surfaces = mesh::groups_named(m, 2, s.group, s.place);
  f.curves = mesh::groups_named(m, 1, s.group, s.place);
  f.points = mesh::groups_named(m, 0, s.group, s.place);
  if (f.none()) refuse_unknown(m, s);
  return f;
}

[[noreturn]] void refuse_kind(Selector const& s, std::string const& what) {
  throw core::InputError(s.place,
                         fmt::format("group '{}' has no {}: name a surface or volume group, or use a plane "
                                     "or a box",
                                     s.group, what));
}

/// What a group of one kind selects.
struct Meaning {
  int dimension;
  std::vector<int> chosen; ///< ascending
};

/// The one thing that all meanings of a name select; a name with different ones is refused.
std::vector<int> only_meaning(std::vector<Meaning> meanings, Selector const& s, std::string const& what) {
  auto const selects = [](Meaning const& k) { return !k.chosen.empty(); };
  if (std::any_of(meanings.begin(), meanings.end(), selects)) // bars of a set have no nodes of tets
    std::erase_if(meanings, [&](Meaning const& k) { return !selects(k); });
  auto& first = meanings.front();
  for (auto const& other : meanings) {
    if (other.chosen == first.chosen) continue;
    auto const kind = [](Meaning const& k) {
      return mesh::kinds_of_groups[static_cast<std::size_t>(k.dimension)];
    };
    throw core::InputError(
        s.place,
        fmt::format("the name '{0}' stands for a {1} group ({3} {5}) and a {2} group ({4} {5}) of "
                    "the mesh: write \"{1}:{0}\" or \"{2}:{0}\"",
                    s.group, kind(first), kind(other), first.chosen.size(), other.chosen.size(), what));
  }
  return std::move(first.chosen);
}

/// Points of tets in the groups of a name.
std::vector<int> points_of_group(Mesh const& m, Selector const& s, std::vector<char> const& used) {
  Found const f = find_group(m, s);
  std::vector<Meaning> meanings;
  auto const add = [&](int dimension, std::vector<int> const& groups, auto const& choose_from) {
    if (groups.empty()) return;
    std::vector<char> chosen(m.points.size(), 0);
    for (int const g : groups)
      choose_from(g, [&](auto const& item) {
        for (int const p : item) chosen[p] = 1;
      });
    meanings.push_back({dimension, {}});
    for (int p = 0; p < static_cast<int>(chosen.size()); ++p)
      if (chosen[p] && used[p]) meanings.back().chosen.push_back(p);
  };
  add(3, f.tets, [&](int t, auto const& choose) { choose(m.tets[t]); });
  add(2, f.surfaces, [&](int g, auto const& choose) {
    for (auto const& t : m.face_groups[g].triangles) choose(t);
  });
  add(1, f.curves, [&](int g, auto const& choose) {
    for (auto const& l : m.line_groups[g].segments) choose(l);
  });
  add(0, f.points, [&](int g, auto const& choose) { choose(m.point_groups[g].points); });
  return only_meaning(std::move(meanings), s, "nodes");
}

/// Per tet whether it is in the list.
std::vector<char> marked(Mesh const& m, std::vector<int> const& tets) {
  std::vector<char> mark(m.tets.size(), 0);
  for (int const t : tets) mark[t] = 1;
  return mark;
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

/// The boundary faces that are triangles of surface groups, as 4 x tet + face, and how many triangles are
/// not.
struct OuterFaces {
  std::vector<int> faces;
  std::size_t inner = 0, triangles = 0;
};
OuterFaces faces_of_surfaces(Mesh const& m, mesh::Adjacency const& adjacency,
                             std::vector<int> const& groups) {
  mesh::FaceFinder const finder(m);
  OuterFaces found;
  for (int const g : groups) {
    for (auto const& t : m.face_groups[g].triangles) {
      auto const sides = finder.find(t);
      if (sides.size() == 1 && adjacency.shared_of_tet[sides[0].tet][sides[0].face] < 0)
        found.faces.push_back(4 * sides[0].tet + sides[0].face);
      else
        ++found.inner;
    }
    found.triangles += m.face_groups[g].triangles.size();
  }
  std::sort(found.faces.begin(), found.faces.end());
  return found;
}

/// Boundary faces by the group's tets or triangles.
std::vector<TetFace> faces_of_group(Mesh const& m, mesh::Adjacency const& adjacency, Selector const& s) {
  Found const f = find_group(m, s);
  if (f.tets.empty() && f.surfaces.empty()) refuse_kind(s, "faces");
  std::vector<Meaning> meanings;
  if (!f.tets.empty()) {
    auto const mine = marked(m, f.tets);
    meanings.push_back({3, {}});
    for (TetFace const b : adjacency.boundary)
      if (mine[b.tet]) meanings.back().chosen.push_back(4 * b.tet + b.face);
  }
  std::size_t inner = 0, triangles = 0;
  if (!f.surfaces.empty()) {
    auto found = faces_of_surfaces(m, adjacency, f.surfaces);
    inner = found.inner, triangles = found.triangles;
    meanings.push_back({2, std::move(found.faces)});
  }
  auto const chosen = only_meaning(std::move(meanings), s, "outer faces");
  if (inner > 0)
    throw core::InputError(s.place,
                           fmt::format("{} of the {} triangles of group '{}' are not on the boundary of the "
                                       "body; faces to load must be outer ones",
                                       inner, triangles, s.group));
  std::vector<TetFace> faces;
  for (int const c : chosen) faces.push_back({c / 4, c % 4});
  return faces;
}

std::vector<int> shared_of_group(Mesh const& m, mesh::Adjacency const& adjacency, Selector const& s) {
  Found const f = find_group(m, s);
  if (f.tets.empty() && f.surfaces.empty()) refuse_kind(s, "joints");
  std::vector<Meaning> meanings;
  if (!f.tets.empty()) {
    auto const mine = marked(m, f.tets);
    meanings.push_back({3, {}});
    for (int i = 0; i < static_cast<int>(adjacency.shared.size()); ++i)
      if (mine[adjacency.shared[i].a.tet] || mine[adjacency.shared[i].b.tet])
        meanings.back().chosen.push_back(i);
  }
  if (!f.surfaces.empty()) {
    mesh::FaceFinder const finder(m);
    meanings.push_back({2, {}});
    auto& chosen = meanings.back().chosen;
    for (int const g : f.surfaces)
      for (auto const& t : m.face_groups[g].triangles)
        for (TetFace const side : finder.find(t))
          if (int const shared = adjacency.shared_of_tet[side.tet][side.face]; shared >= 0)
            chosen.push_back(shared);
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  }
  return only_meaning(std::move(meanings), s, "joints");
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
    chosen = points_of_group(m, s, used);
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
  auto chosen = find_group(m, s).tets;
  if (chosen.empty())
    throw core::InputError(s.place, fmt::format("group '{}' has no tets: name a volume group", s.group));
  return non_empty(std::move(chosen), m, s, "tet");
}

std::vector<int> select_shared_faces(Mesh const& m, mesh::Adjacency const& adjacency, Selector const& s) {
  if (s.kind == Kind::group) return non_empty(shared_of_group(m, adjacency, s), m, s, "joint");
  auto const centroid = [&](int i) {
    return geometry::centroid(mesh::face_triangle(m, adjacency.shared[i].a));
  };
  return non_empty(select_places(m, s, adjacency.shared.size(), always, centroid), m, s, "joint");
}

bool names_tets(Mesh const& m, Selector const& s) {
  return s.kind == Kind::group && !mesh::tets_named(m, s.group, s.place).empty();
}

} // namespace fissura::model
