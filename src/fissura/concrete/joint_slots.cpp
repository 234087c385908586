// Where the tets find the forces of their joints: the gather tables of the tet kernel.
#include <algorithm>

#include "fissura/concrete/concrete.hpp"

namespace fissura::concrete {

using model::Model;

namespace {

/// Lets one side of a joint take the forces that start at `from`, corner by corner.
void connect(state::JointSlots& slots, mesh::TetFace side, std::array<int, 3> const& corner, double sign,
             std::size_t from) {
  auto const tet = static_cast<std::size_t>(side.tet);
  slots.sign[model::at(tet, side.face, 4)] = sign;
  auto const& list = mesh::face_corners[side.face];
  for (int k = 0; k < 3; ++k) {
    auto const i = static_cast<int>(std::find(list.begin(), list.end(), corner[k]) - list.begin());
    slots.place[model::at(tet, 3 * side.face + i, 12)] = static_cast<int>(from) + 4 * k;
  }
}

} // namespace

state::JointSlots make_joint_slots(Model const& m) {
  std::size_t const joints = m.joints.blocks() * model::block, tets = m.tets.blocks() * model::block;
  state::JointSlots slots;
  slots.force = core::Buffer<double>(2 * 12 * joints + 16);
  slots.place = core::Buffer<int>(12 * tets);
  slots.sign = core::Buffer<double>(4 * tets);
  std::fill(slots.place.begin(), slots.place.end(), static_cast<int>(12 * joints)); // the zeros
  for (int i = 0; i < m.joints.count; ++i) {
    auto const& face = m.adjacency.shared[m.joints.joints[i].shared_face];
    std::size_t const from = 12 * static_cast<std::size_t>(i);
    connect(slots, face.a, face.corner_a, 1, from); // tension pulls side a towards b
    connect(slots, face.b, face.corner_b, -1, from);
  }
  return slots;
}

void separate_sides(Model const& m, state::JointSlots& slots, int joint) {
  auto const& face = m.adjacency.shared[m.joints.joints[joint].shared_face];
  connect(slots, face.b, face.corner_b, 1, slots.side_b(joint));
}

} // namespace fissura::concrete
