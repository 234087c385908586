#include "fissura/rebar/activation.hpp"

#include <algorithm>

namespace fissura::rebar {

namespace {

/// Displacement of side b less that of side a at the crossing [m].
Vec3 jump_at(model::FaceCrossing const& face, mesh::SharedFace const& shared, Nodes const& nodes) {
  Vec3 d;
  for (int k = 0; k < 3; ++k)
    d += face.weights[k] * (nodes.displacement(shared.b.tet, shared.corner_b[k]) -
                            nodes.displacement(shared.a.tet, shared.corner_a[k]));
  return d;
}

Vec3 mid_normal(mesh::SharedFace const& shared, Nodes const& nodes) {
  Vec3 x[3];
  for (int k = 0; k < 3; ++k)
    x[k] = 0.5 * (nodes.current(shared.a.tet, shared.corner_a[k]) +
                  nodes.current(shared.b.tet, shared.corner_b[k]));
  return unit(cross(x[1] - x[0], x[2] - x[0]));
}

} // namespace

laws::Separation separation_at(model::FaceCrossing const& face, mesh::SharedFace const& shared,
                               Nodes const& nodes) {
  Vec3 const d = jump_at(face, shared, nodes), n = mid_normal(shared, nodes);
  double const opening = dot(d, n);
  return {opening, norm(d - opening * n), 0};
}

bool separates(model::FaceCrossing const& face, mesh::SharedFace const& shared,
               laws::CohesiveParams const& law, Nodes const& nodes) {
  if (!law.crackable) return false;
  // Neither opening nor sliding exceeds the length of the jump, and s_p is never below f_s/k: most faces end
  // here.
  Vec3 const d = jump_at(face, shared, nodes);
  double const surely_intact = std::min(law.o_p, law.f_s / law.k);
  if (dot(d, d) < surely_intact * surely_intact) return false;
  return laws::cohesive_damage(law, laws::CohesiveHistory{}, separation_at(face, shared, nodes)) > 0;
}

} // namespace fissura::rebar
