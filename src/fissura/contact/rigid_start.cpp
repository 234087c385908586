// What can be wrong with rigid bodies before anything moves.
#include <algorithm>
#include <fmt/core.h>

#include "fissura/contact/rigid.hpp"
#include "fissura/contact/rigid_face.hpp"
#include "fissura/contact/rigid_shape.hpp"
#include "fissura/geometry/tet.hpp"

namespace fissura::contact {

using model::Model;
using model::RigidBody;

namespace {

constexpr double hair = 1e-6; // of the tet's size

/// The deepest place of concrete inside a body.
struct Overlap {
  double depth = 0; ///< [m]
  Vec3 where;
  int tet = -1;
};

void look_at(Model const& m, RigidBody const& body, int tet, Vec3 x, Overlap& worst) {
  double const depth = -distance(body, x).value;
  double const size = geometry::regular_edge(m.tets.volume[static_cast<std::size_t>(tet)]);
  if (depth > std::max(worst.depth, hair * size)) worst = {depth, x, tet};
}

/// A body that lies within a tet reaches no point of its faces: its middle tells.
void look_inside(Model const& m, RigidBody const& body, int tet, Overlap& worst) {
  auto const l = geometry::barycentric(mesh::corners(m.mesh, tet), body.centre);
  if (*std::min_element(l.begin(), l.end()) >= 0) look_at(m, body, tet, body.centre, worst);
}

Overlap deepest_overlap(Model const& m, RigidBody const& body) {
  Overlap worst;
  for (auto const& f : m.adjacency.boundary) {
    Triangle const x = on_face(m.position, f.tet, f.face);
    for (auto const& q : face_points) look_at(m, body, f.tet, at(x, q), worst);
  }
  if (body.is_impactor)
    for (int t = 0; t < m.tets.count; ++t) look_inside(m, body, t, worst);
  return worst;
}

char const* noun(RigidBody const& body) {
  return body.is_impactor ? "impactor" : "plane";
}

} // namespace

void check_rigid_start(Model const& m) {
  std::vector<core::Diagnostic> wrong;
  for (auto const& body : m.rigid) {
    auto const o = deepest_overlap(m, body);
    if (o.tet < 0) continue;
    wrong.push_back(
        {body.place,
         fmt::format("{} `{}` overlaps the concrete at t = 0: tet {} of group {} lies {:.4g} m deep in it at "
                     "({:.6g}, {:.6g}, {:.6g}) m; move one of them until they touch at most",
                     noun(body), body.name, m.mesh.input_id[static_cast<std::size_t>(o.tet)],
                     m.mesh.volume_groups[static_cast<std::size_t>(
                         m.mesh.tet_group[static_cast<std::size_t>(o.tet)])],
                     o.depth, o.where.x, o.where.y, o.where.z)});
  }
  if (!wrong.empty()) throw core::InputError(std::move(wrong));
}

std::vector<std::string> rigid_warnings(Model const& m) {
  double volume = 0;
  for (int t = 0; t < m.tets.count; ++t) volume += m.tets.volume[static_cast<std::size_t>(t)];
  double const spacing = 0.5 * geometry::regular_edge(volume / std::max(1, m.tets.count));
  std::vector<std::string> found;
  for (auto const& body : m.rigid)
    if (smallest_half_extent(body) < spacing)
      found.push_back(fmt::format("impactor `{}` is small beside the mesh (half of it {:.3g} m, half a tet "
                                  "{:.3g} m): it may pass between the points where it is felt",
                                  body.name, smallest_half_extent(body), spacing));
  return found;
}

} // namespace fissura::contact
