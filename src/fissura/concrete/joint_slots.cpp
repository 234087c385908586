// Where the tets find the forces of their joints: the gather tables of the tet kernel.
#include <algorithm>
#include <array>

#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/joint_lanes.hpp"

namespace fissura::concrete {

using model::Model;
using state::JointStatus;

namespace {

/// Lets one side of a joint take the forces that start at `from`, corner by corner.
void connect(state::JointSlots& slots, mesh::TetFace side, mesh::FaceCorners const& corner, float sign,
             std::size_t from) {
  auto const tet = static_cast<std::size_t>(side.tet);
  slots.sign[model::at(tet, side.face, 4)] = sign;
  auto const& list = mesh::face_corners[side.face];
  for (int k = 0; k < 3; ++k) {
    auto const i = static_cast<int>(std::find(list.begin(), list.end(), corner[k]) - list.begin());
    slots.place[model::at(tet, 3 * side.face + i, 12)] = static_cast<int>(from) + core::per_node * k;
  }
}

void append(std::vector<double>& to, laws::CohesiveParams const& p) {
  auto const one_if = [](bool b) { return b ? 1.0 : 0.0; };
  std::array<double, state::doubles_per_law> const row{p.f_t,
                                                       p.o_r,
                                                       p.f_s,
                                                       p.tan_phi,
                                                       p.friction,
                                                       p.shear_work,
                                                       1 / p.shear_work,
                                                       1 / p.o_r,
                                                       one_if(p.mohr_coulomb),
                                                       one_if(p.straight_tension),
                                                       one_if(p.straight_shear),
                                                       one_if(p.law == laws::CohesiveLaw::paper)};
  to.insert(to.end(), row.begin(), row.end());
}

} // namespace

state::JointSlots make_joint_slots(Model const& m, state::State const& s) {
  std::size_t const joints = m.joints.blocks() * model::block, tets = m.tets.blocks() * model::block;
  state::JointSlots slots;
  std::size_t const groups = s.joint_history.groups();
  slots.joints = joints;
  slots.force = core::Buffer<double>(slots.nobody(groups));
  slots.place = core::Buffer<int>(12 * tets);
  slots.sign = core::Buffer<float>(4 * tets);
  slots.batches = core::Buffer<state::JointBatch>(m.joints.blocks());
  for (auto const& law : m.joints.kinds) append(slots.laws, law);
  std::fill(slots.place.begin(), slots.place.end(), static_cast<int>(slots.zeros()));
  for (int i = 0; i < m.joints.count; ++i) {
    auto const& face = m.adjacency.shared[m.joints.joints[i].shared_face];
    auto const status = static_cast<JointStatus>(s.joint_status[static_cast<std::size_t>(i)]);
    if (status == JointStatus::released) continue;
    connect(slots, face.a, face.corner_a, 1, slots.side_a(i)); // tension pulls side a towards b
    connect(slots, face.b, face.corner_b, -1, slots.side_a(i));
    if (status == JointStatus::intact) continue;
    separate_sides(m, slots, i);
    fill_lane(m, s, slots, s.joint_history.lane[static_cast<std::size_t>(i)], i);
  }
  for (std::size_t g = 0; g < groups; ++g) {
    slots.lanes.push_back(state::count_lanes(s, g));
    set_taken(slots, g, slots.lanes[g].at_work);
  }
  return slots;
}

void separate_sides(Model const& m, state::JointSlots& slots, int joint) {
  auto const& face = m.adjacency.shared[m.joints.joints[joint].shared_face];
  connect(slots, face.b, face.corner_b, 1, slots.side_b(joint));
}

void remove_from_slots(Model const& m, state::JointSlots& slots, int joint) {
  auto const& face = m.adjacency.shared[m.joints.joints[joint].shared_face];
  for (auto const side : {face.a, face.b}) {
    auto const tet = static_cast<std::size_t>(side.tet);
    slots.sign[model::at(tet, side.face, 4)] = 0;
    for (int k = 0; k < 3; ++k)
      slots.place[model::at(tet, 3 * side.face + k, 12)] = static_cast<int>(slots.zeros());
  }
}

} // namespace fissura::concrete
