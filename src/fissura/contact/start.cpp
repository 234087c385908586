// Bodies that stand in each other at the start: a mistake in the mesh that no spring should have to push
// apart.
#include <algorithm>
#include <fmt/core.h>

#include "fissura/contact/broad_phase.hpp"
#include "fissura/contact/contact.hpp"
#include "fissura/contact/tet_overlap.hpp"
#include "fissura/core/error.hpp"
#include "fissura/geometry/tet.hpp"

namespace fissura::contact {

namespace {

constexpr double admitted = 1e-3; ///< of the smaller tet's volume
constexpr int told = 5;

} // namespace

void check_start(model::Model const& m) {
  auto const body = mesh::connected_bodies(m.mesh, m.adjacency);
  if (!m.source.contact.on || *std::max_element(body.begin(), body.end()) == 0) return;
  std::vector<Box> boxes;
  for (int t = 0; t < m.tet_count(); ++t) {
    auto const x = mesh::corners(m.mesh, t);
    Box b{x[0], x[0]};
    for (Vec3 const p : x)
      for (int r = 0; r < 3; ++r) b.low[r] = std::min(b.low[r], p[r]), b.high[r] = std::max(b.high[r], p[r]);
    boxes.push_back(b);
  }
  std::string places;
  int found = 0;
  for (auto const& [i, k] : meeting_boxes(boxes)) {
    if (body[i] == body[k]) continue;
    auto const a = mesh::corners(m.mesh, i), b = mesh::corners(m.mesh, k);
    auto const o = overlap(make_tet_now(a, a), make_tet_now(b, b));
    if (!(o.volume > admitted * std::min(geometry::volume(a), geometry::volume(b)))) continue;
    if (found++ < told)
      places += fmt::format("{}tets {} and {} at ({:.4g}, {:.4g}, {:.4g}) m", found > 1 ? "; " : "",
                            m.mesh.input_id[i], m.mesh.input_id[k], o.centroid.x, o.centroid.y, o.centroid.z);
  }
  if (found > 0)
    throw core::InputError(
        m.source.mesh.place,
        fmt::format("bodies overlap at the start in {} place{}: {}{}; move them apart (touching is "
                    "fine), or join them to one mesh",
                    found, found > 1 ? "s" : "", places, found > told ? "; ..." : ""));
}

} // namespace fissura::contact
