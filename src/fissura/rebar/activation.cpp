#include "fissura/rebar/activation.hpp"

#include <algorithm>
#include <limits>

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

double surely_intact_jump(laws::CohesiveParams const& law) {
  return law.crackable ? std::min(law.o_p, law.f_s / law.k) : std::numeric_limits<double>::infinity();
}

bool separates(model::FaceCrossing const& face, mesh::SharedFace const& shared,
               laws::CohesiveParams const& law, Nodes const& nodes) {
  return laws::cohesive_damage(law, laws::CohesiveHistory{}, separation_at(face, shared, nodes)) > 0;
}

} // namespace fissura::rebar
