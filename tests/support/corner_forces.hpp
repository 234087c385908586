#pragma once
// Forces on the nodes without moving them: the tet kernel writes corner forces instead of integrating.
#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/kernels.hpp"
#include "support/concrete_model.hpp"

namespace fissura::support {

/// Internal forces of tets at u and v [N], with the joint forces and the overlay that `w` holds.
/// Returns what viscosity dissipates in `dt` [J].
inline double corner_forces(model::Model const& m, state::State& s, state::Scratch const& w, double dt,
                            core::NodeField& force, concrete::KernelSet const& set = concrete::kernels()) {
  if (force.nodes() == 0) force = core::NodeField(node_slots(m));
  concrete::TetPass const pass{&m.tets, s.u.data(), s.v.data(), &w.joints, &w.overlay, force.data(),
                               dt,      0,          0,          {},        {},         false};
  return set.tet_forces(pass, 0, m.tets.blocks()).viscous;
}

/// Sum over the copies of each mesh point.
inline std::vector<Vec3> sum_at_points(model::Model const& m, core::NodeField const& force) {
  std::vector<Vec3> sum(m.mesh.points.size());
  for (int n = 0; n < node_count(m); ++n) sum[m.mesh.tets[n / 4][n % 4]] += at_node(force, n);
  return sum;
}

} // namespace fissura::support
