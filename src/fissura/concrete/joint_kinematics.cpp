#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/joint_frame.hpp"

namespace fissura::concrete {

using model::Model;
using state::State;

namespace {

Vec<double> displacement(State const& s, int node, double back) {
  double const *u = s.u.of_node(node), *v = s.v.of_node(node);
  return {u[0] - back * v[0], u[1] - back * v[1], u[2] - back * v[2]};
}

Vec<double> reference_edge(Model const& m, int joint, int which) {
  auto const j = static_cast<std::size_t>(joint);
  auto const& e = m.joints.edge;
  return {e[model::at(j, 3 * which, 6)], e[model::at(j, 3 * which + 1, 6)],
          e[model::at(j, 3 * which + 2, 6)]};
}

Vec3 plain(Vec<double> v) {
  return {v.x, v.y, v.z};
}

} // namespace

JointKinematics joint_kinematics(Model const& m, State const& s, int joint, double back) {
  auto const& j = m.joints.joints[joint];
  Vec<double> a[3], b[3];
  for (int k = 0; k < 3; ++k) {
    a[k] = displacement(s, j.node_a[k], back);
    b[k] = displacement(s, j.node_b[k], back);
  }
  auto f = joint_frame<double>(a, b, reference_edge(m, joint, 0), reference_edge(m, joint, 1));
  add_axes(f);
  JointKinematics r;
  r.normal = plain(f.normal), r.axis_1 = plain(f.axis_1), r.axis_2 = plain(f.axis_2);
  r.mid = {Vec3{}, plain(f.edge_1), plain(f.edge_2)};
  for (int k = 0; k < 3; ++k) {
    r.jump[k] = plain(f.jump[k]);
    auto const at = separation_at(f, k);
    r.at[k] = {at.opening, at.sliding_1, at.sliding_2};
  }
  return r;
}

} // namespace fissura::concrete
