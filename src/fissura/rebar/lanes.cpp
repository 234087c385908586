#include "fissura/rebar/lanes.hpp"

#include <algorithm>
#include <limits>

namespace fissura::rebar {

namespace {

using state::BarLanes;
using state::BarScratch;

template <class Struct> int start(int item) {
  static_assert(sizeof(Struct) % sizeof(double) == 0);
  return item * static_cast<int>(sizeof(Struct) / sizeof(double));
}
int node(int tet, int corner) {
  return core::per_node * model::node_of(tet, corner);
}

/// The items of each eight lanes, the last one repeated.
std::vector<BarLanes> by_eight(std::size_t items) {
  std::vector<BarLanes> all((items + 7) / 8);
  for (std::size_t i = 0; i < 8 * all.size(); ++i)
    all[i / 8][i % 8] = static_cast<int>(std::min(i, items - 1));
  return all;
}

/// The k-th crossing of each joint; where there is none, one that is surely intact.
state::CrossingLanes crossing(model::Model const& m, BarLanes const& joints, int k) {
  state::CrossingLanes lanes{};
  lanes.surely_intact.fill(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < 8; ++i) {
    auto const& joint = m.bars.joints[static_cast<std::size_t>(joints[i])];
    if (k >= joint.faces_end - joint.faces_begin) continue;
    auto const& face = m.bars.faces[static_cast<std::size_t>(joint.faces_begin + k)];
    auto const& shared = m.adjacency.shared[static_cast<std::size_t>(face.shared_face)];
    for (std::size_t c = 0; c < 3; ++c) {
      lanes.node_a[c][i] = node(shared.a.tet, shared.corner_a[c]);
      lanes.node_b[c][i] = node(shared.b.tet, shared.corner_b[c]);
      lanes.weights[c][i] = face.weights[c];
    }
    lanes.surely_intact[i] = face.surely_intact * face.surely_intact;
  }
  return lanes;
}

state::ElementLanes element_lanes(model::Bars const& bars, BarLanes const& elements) {
  state::ElementLanes lanes;
  lanes.index = elements;
  for (std::size_t i = 0; i < 8; ++i) {
    lanes.element[i] = start<model::BarElement>(elements[i]);
    lanes.host[i] = node(bars.elements[static_cast<std::size_t>(elements[i])].tet, 0);
    lanes.now[i] = start<BarScratch::Element>(elements[i]);
  }
  return lanes;
}

state::BarJointLanes joint_lanes(model::Model const& m, BarLanes const& joints, BarScratch& w) {
  state::BarJointLanes lanes;
  int most = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    auto const& j = m.bars.joints[static_cast<std::size_t>(joints[i])];
    lanes.joint[i] = start<model::BarJoint>(joints[i]);
    lanes.host_a[i] = node(j.tet_a, 0), lanes.host_b[i] = node(j.tet_b, 0);
    lanes.frame_0[i] = node(j.tet_a, j.frame_edge[0]), lanes.frame_1[i] = node(j.tet_a, j.frame_edge[1]);
    lanes.element_a[i] = start<BarScratch::Element>(j.elem_a);
    lanes.element_b[i] = start<BarScratch::Element>(j.elem_b);
    lanes.now[i] = start<BarScratch::Joint>(joints[i]);
    most = std::max(most, j.faces_end - j.faces_begin);
  }
  lanes.crossings_begin = static_cast<int>(w.crossing_lanes.size());
  for (int k = 0; k < most; ++k) w.crossing_lanes.push_back(crossing(m, joints, k));
  lanes.crossings_end = static_cast<int>(w.crossing_lanes.size());
  return lanes;
}

} // namespace

void make_bar_lanes(model::Model const& m, BarScratch& w) {
  for (auto const& eight : by_eight(m.bars.elements.size()))
    w.element_lanes.push_back(element_lanes(m.bars, eight));
  for (auto const& eight : by_eight(m.bars.joints.size())) w.joint_lanes.push_back(joint_lanes(m, eight, w));
}

} // namespace fissura::rebar
