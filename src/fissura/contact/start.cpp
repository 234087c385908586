// Bodies that stand in each other at the start: a mistake in the mesh that no spring should have to push
// apart, or curved faces whose facets cut into each other.
#include <algorithm>
#include <fmt/core.h>

#include "fissura/contact/broad_phase.hpp"
#include "fissura/contact/contact.hpp"
#include "fissura/contact/facets.hpp"
#include "fissura/contact/tet_overlap.hpp"
#include "fissura/core/error.hpp"
#include "fissura/geometry/tet.hpp"

namespace fissura::contact {

namespace {

constexpr double admitted = 1e-3; ///< of the smaller tet's volume
constexpr int told = 5;
/// Facets explain an overlap of up to so many sagittas: those of both bodies, and the triangles across them.
constexpr double sagittas = 3;

struct Overlaps {
  int count = 0;
  double deepest = 0;   ///< [m]
  std::string places;   ///< of the first few
  std::vector<char> in; ///< per tet
};

Overlaps find_overlaps(model::Model const& m, std::vector<int> const& body) {
  std::vector<Box> boxes;
  for (int t = 0; t < m.tet_count(); ++t) {
    auto const x = mesh::corners(m.mesh, t);
    Box b{x[0], x[0]};
    for (Vec3 const p : x)
      for (int r = 0; r < 3; ++r) b.low[r] = std::min(b.low[r], p[r]), b.high[r] = std::max(b.high[r], p[r]);
    boxes.push_back(b);
  }
  Overlaps found;
  found.in.assign(boxes.size(), 0);
  for (auto const& [i, k] : meeting_boxes(boxes)) {
    if (body[i] == body[k]) continue;
    auto const a = mesh::corners(m.mesh, i), b = mesh::corners(m.mesh, k);
    auto const o = overlap(make_tet_now(a, a), make_tet_now(b, b));
    if (!(o.volume > admitted * std::min(geometry::volume(a), geometry::volume(b)))) continue;
    found.in[i] = found.in[k] = 1;
    found.deepest = std::max(found.deepest, o.energy / o.volume); // two flat faces: A g^2 over A g
    if (found.count++ < told)
      found.places +=
          fmt::format("{}tets {} and {} at ({:.4g}, {:.4g}, {:.4g}) m", found.count > 1 ? "; " : "",
                      m.mesh.input_id[i], m.mesh.input_id[k], o.centroid.x, o.centroid.y, o.centroid.z);
  }
  if (found.count > told) found.places += "; ...";
  return found;
}

} // namespace

std::string check_start(model::Model const& m) {
  auto const& contact = m.source.contact;
  auto const body = mesh::connected_bodies(m.mesh, m.adjacency);
  if (!contact.on || *std::max_element(body.begin(), body.end()) == 0) return {};
  auto const found = find_overlaps(m, body);
  if (found.count == 0) return {};
  std::string const what = fmt::format("bodies overlap at the start in {} place{}, by up to {:.3g} m: {}",
                                       found.count, found.count > 1 ? "s" : "", found.deepest, found.places);
  if (contact.initial_overlap == model::InitialOverlap::zero)
    return what + "; there the springs of contact start from this overlap, without a force";
  double const sagitta = largest_sagitta(m.mesh, m.adjacency, found.in);
  if (sagitta > 0 && found.deepest <= sagittas * sagitta)
    throw core::InputError(
        m.source.mesh.place,
        fmt::format(
            "{}. The facets of curved faces there stand off their arcs by up to {:.3g} m (the sagitta, "
            "edge^2/(8 radius)), so bodies that were meshed apart cut into each other by about that: give "
            "both "
            "the same facets (mesh them as one), use a finer mesh, or set [contact] initial_overlap = "
            "\"zero\"",
            what, sagitta));
  throw core::InputError(
      m.source.mesh.place,
      fmt::format("{}; move them apart (touching is fine), join them to one mesh, or, where the "
                  "overlap is meant, set [contact] initial_overlap = \"zero\"",
                  what));
}

} // namespace fissura::contact
