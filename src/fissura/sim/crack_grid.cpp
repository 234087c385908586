// Damaged joints as triangles, midway between their faces.
#include "fissura/sim/fields.hpp"
#include "fissura/sim/joint_fields.hpp"

namespace fissura::sim {

using model::Model;
using output::Grid;
using state::State;

namespace {

Grid grid_of(Model const& m, State const& s, std::vector<int> const& joints) {
  Grid g;
  JointFields fields;
  std::vector<float> displacement;
  for (int const j : joints) {
    auto const& joint = m.joints.joints[static_cast<std::size_t>(j)];
    for (int k = 0; k < 3; ++k) {
      Vec3 const u = 0.5 * (s.u.at(joint.node_a[k]) + s.u.at(joint.node_b[k]));
      g.connectivity.push_back(static_cast<std::int64_t>(g.points.size()));
      g.points.push_back(m.position.at(joint.node_a[k]));
      for (int r = 0; r < 3; ++r) displacement.push_back(static_cast<float>(u[r]));
    }
    g.offsets.push_back(static_cast<std::int64_t>(g.points.size()));
    g.types.push_back(output::cell_type::triangle);
    fields.add(m, s, j);
  }
  g.point_data = {{"displacement", 3, displacement, "m"}};
  g.cell_data = fields.arrays();
  return g;
}

std::vector<int> damaged_joints(Model const& m, State const& s) {
  std::vector<int> joints;
  for (int j = 0; j < m.joints.count; ++j)
    if (static_cast<state::JointStatus>(s.joint_status[j]) != state::JointStatus::intact) joints.push_back(j);
  return joints;
}

} // namespace

Grid crack_grid(Model const& m, State const& s) {
  return grid_of(m, s, damaged_joints(m, s));
}

Grid crack_frame(Model const& m, State const& s) {
  auto joints = damaged_joints(m, s);
  if (joints.empty() && m.joints.count > 0) joints = {0};
  return grid_of(m, s, joints);
}

} // namespace fissura::sim
