#include "fissura/mesh/check.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/core.h>

#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/faces.hpp"
#include "fissura/mesh/overlap.hpp"

namespace fissura::mesh {

namespace {

std::string at(Vec3 p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", p.x, p.y, p.z);
}

int number_of(Mesh const& m, int tet) {
  return tet < static_cast<int>(m.input_id.size()) ? m.input_id[tet] : tet;
}

std::string tet_at(Mesh const& m, int tet) {
  return fmt::format("tet {} at {}", number_of(m, tet), at(geometry::centroid(corners(m, tet))));
}

/// The faults of one kind: how many, and the first few in words.
class Cases {
 public:
  void add(std::string words) {
    if (count++ < 5) list += (list.empty() ? "" : "; ") + words;
  }
  bool any() const { return count > 0; }
  std::string text(std::string const& kind) const {
    return fmt::format("{}: {} ({}{})", kind, count, list, count > 5 ? "; ..." : "");
  }

 private:
  long count = 0;
  std::string list;
};

class Findings {
 public:
  explicit Findings(core::Place place_) : place(std::move(place_)) {}
  void add(std::string message) { all.push_back({place, std::move(message)}); }
  void add(Cases const& cases, std::string const& kind) {
    if (cases.any()) add(cases.text(kind));
  }
  void add(core::InputError const& error) {
    for (auto const& d : error.diagnostics) add(d.message);
  }
  /// Later checks rely on what the earlier ones looked at.
  void throw_if_any() const {
    if (!all.empty()) throw core::InputError(all);
  }

 private:
  core::Place place;
  std::vector<core::Diagnostic> all;
};

void check_points(Mesh const& m, Findings& findings) {
  Cases cases;
  for (std::size_t p = 0; p < m.points.size(); ++p) {
    Vec3 const x = m.points[p];
    if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z))
      cases.add(fmt::format("point {} at {}", p, at(x)));
  }
  findings.add(cases, "points whose coordinates are not finite numbers");
}

/// Every index in the mesh names something that exists, and no group is empty.
void check_indices(Mesh const& m, Findings& findings) {
  auto const exists = [&](int p) { return p >= 0 && p < static_cast<int>(m.points.size()); };
  Cases tets;
  for (std::size_t t = 0; t < m.tets.size(); ++t)
    if (!std::all_of(m.tets[t].begin(), m.tets[t].end(), exists))
      tets.add(fmt::format("tet {}", number_of(m, static_cast<int>(t))));
  findings.add(tets, "tets with a corner that is no point of the mesh");
  auto const check_group = [&](std::string const& kind, std::string const& name, auto const& items,
                               auto valid) {
    if (items.empty()) findings.add(fmt::format("{} group '{}' is empty", kind, name));
    if (!std::all_of(items.begin(), items.end(), valid))
      findings.add(fmt::format("{} group '{}' has a point that is no point of the mesh", kind, name));
  };
  auto const all_exist = [&](auto const& item) { return std::all_of(item.begin(), item.end(), exists); };
  for (auto const& g : m.face_groups) check_group("surface", g.name, g.triangles, all_exist);
  for (auto const& g : m.line_groups) check_group("curve", g.name, g.segments, all_exist);
  for (auto const& g : m.point_groups) check_group("point", g.name, g.points, exists);
}

void check_volume_groups(Mesh const& m, Findings& findings) {
  std::vector<long> size(m.volume_groups.size(), 0);
  Cases lost;
  for (std::size_t t = 0; t < m.tets.size(); ++t) {
    int const g = t < m.tet_group.size() ? m.tet_group[t] : -1;
    if (g >= 0 && g < static_cast<int>(size.size()))
      ++size[g];
    else
      lost.add(fmt::format("tet {}", number_of(m, static_cast<int>(t))));
  }
  findings.add(lost, "tets that belong to no volume group");
  for (std::size_t g = 0; g < size.size(); ++g)
    if (size[g] == 0)
      findings.add(fmt::format("volume group '{}' is empty; a .msh of format 2.2 saved with Mesh.SaveAll "
                               "loses its groups: save as 4.1",
                               m.volume_groups[g]));
}

void check_volumes(Mesh const& m, Findings& findings) {
  Cases inverted, flat;
  for (int t = 0; t < static_cast<int>(m.tets.size()); ++t) {
    auto const x = corners(m, t);
    double const altitude = geometry::smallest_altitude(x);
    double const limit = 1e-6 * geometry::longest_edge(x);
    double const v = geometry::volume(x);
    // The smallest altitude of an inverted tet is its most negative one: look at the largest, nearest to
    // zero.
    auto const h = geometry::altitudes(x);
    bool const thin = v > 0 ? altitude <= limit : *std::max_element(h.begin(), h.end()) >= -limit;
    if (thin)
      flat.add(tet_at(m, t));
    else if (v < 0)
      inverted.add(tet_at(m, t));
  }
  findings.add(flat, "tets without volume");
  findings.add(inverted, "inverted tets (negative volume)");
}

void check_duplicates(Mesh const& m, Findings& findings) {
  struct Key {
    std::array<int, 4> points;
    int tet;
    auto operator<=>(Key const&) const = default;
  };
  std::vector<Key> keys;
  for (int t = 0; t < static_cast<int>(m.tets.size()); ++t) {
    keys.push_back({m.tets[t], t});
    std::sort(keys.back().points.begin(), keys.back().points.end());
  }
  std::sort(keys.begin(), keys.end());
  Cases cases;
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i].points == keys[i - 1].points)
      cases.add(fmt::format("tets {} and {} at {}", number_of(m, keys[i - 1].tet), number_of(m, keys[i].tet),
                            at(geometry::centroid(corners(m, keys[i].tet)))));
  findings.add(cases, "tets stand twice: a volume in two physical groups? (The .msh format 2.2 repeats its "
                      "elements for each of them.) Duplicate tets");
}

/// Across a shared face the fourth corner of the second tet must lie outside the first.
void check_folds(Mesh const& m, Adjacency const& adjacency, Findings& findings) {
  Cases cases;
  for (auto const& s : adjacency.shared) {
    auto const f = face_triangle(m, s.a);
    Vec3 const other = m.points[m.tets[s.b.tet][s.b.face]];
    if (geometry::volume({f[0], f[1], f[2], other}) > 0) continue;
    cases.add(fmt::format("tets {} and {} at {}", number_of(m, s.a.tet), number_of(m, s.b.tet),
                          at(geometry::centroid(f))));
  }
  findings.add(cases, "pairs of tets that lie on the same side of their common face, so they overlap");
}

void check_overlaps(Mesh const& m, Adjacency const& adjacency, Findings& findings) {
  Cases cases;
  for (auto const& o : find_overlaps(m, adjacency)) {
    if (o.coincident || (!m.tet_body.empty() && m.tet_body[o.a.tet] != m.tet_body[o.b.tet])) continue;
    cases.add(fmt::format("tets {} and {} at {}", number_of(m, o.a.tet), number_of(m, o.b.tet), at(o.place)));
  }
  findings.add(
      cases,
      "pairs of boundary faces that overlap without matching (hanging faces: the cells of touching "
      "boxes must match, and no node may lie inside a face or on its edge; to let them touch by contact, "
      "give the boxes different `body` names, or set separate = true in [mesh] for a file)");
}

void check_surface_groups(Mesh const& m, Findings& findings) {
  FaceFinder const finder(m);
  for (auto const& g : m.face_groups) {
    Cases cases;
    for (auto const& t : g.triangles)
      if (finder.find(t).empty())
        cases.add(at(geometry::centroid(geometry::Triangle{m.points[t[0]], m.points[t[1]], m.points[t[2]]})));
    findings.add(cases, fmt::format("triangles of surface group '{}' that are no faces of tets", g.name));
  }
}

} // namespace

void check_mesh(Mesh const& mesh, core::Place const& place) {
  Findings findings(place);
  if (mesh.tets.empty()) findings.add("the mesh has no tets");
  check_points(mesh, findings);
  check_indices(mesh, findings);
  check_volume_groups(mesh, findings);
  findings.throw_if_any();

  check_volumes(mesh, findings);
  check_duplicates(mesh, findings);
  findings.throw_if_any();

  try {
    Adjacency const adjacency = make_adjacency(mesh);
    check_folds(mesh, adjacency, findings);
    check_overlaps(mesh, adjacency, findings);
  } catch (core::InputError const& error) {
    findings.add(error);
  }
  check_surface_groups(mesh, findings);
  findings.throw_if_any();
}

} // namespace fissura::mesh
