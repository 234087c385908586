#pragma once
// Where the two faces of a joint are: their mid-triangle, its normal and axes, and the separations at the
// three mid-edges. For one joint (V = double) or a pack.
#include "fissura/laws/cohesive_law.hpp"

namespace fissura::concrete {
inline namespace FISSURA_ISA {

using core::Vec;

template <class V> struct JointFrame {
  Vec<V> jump[3];        ///< of the node pairs, side b minus side a [m]
  Vec<V> edge_1, edge_2; ///< of the mid-triangle, from its first corner [m]
  Vec<V> normal;         ///< from a to b
  Vec<V> axis_1, axis_2; ///< in its plane; only with axes
};

/// The mid-triangle from its reference edges and the displacements of both sides: so small jumps lose no
/// digits.
template <class V>
inline JointFrame<V> joint_frame(Vec<V> const (&on_a)[3], Vec<V> const (&on_b)[3], Vec<V> reference_1,
                                 Vec<V> reference_2) {
  V const half(0.5);
  JointFrame<V> f;
  Vec<V> mean[3];
  for (int k = 0; k < 3; ++k) {
    f.jump[k] = on_b[k] - on_a[k];
    mean[k] = half * (on_a[k] + on_b[k]);
  }
  f.edge_1 = reference_1 + (mean[1] - mean[0]);
  f.edge_2 = reference_2 + (mean[2] - mean[0]);
  Vec<V> const area = core::cross(f.edge_1, f.edge_2);
  f.normal = core::inverse_root(core::dot(area, area)) * area;
  return f;
}

template <class V> inline void add_axes(JointFrame<V>& f) {
  f.axis_1 = core::inverse_root(core::dot(f.edge_1, f.edge_1)) * f.edge_1;
  f.axis_2 = core::cross(f.normal, f.axis_1);
}

/// Jump at mid-edge 01, 12 or 20.
template <class V> inline Vec<V> jump_at(JointFrame<V> const& f, int edge) {
  return V(0.5) * (f.jump[edge] + f.jump[(edge + 1) % 3]);
}

template <class V> inline laws::SeparationPack<V> separation_at(JointFrame<V> const& f, int edge) {
  Vec<V> const d = jump_at(f, edge);
  return {core::dot(d, f.normal), core::dot(d, f.axis_1), core::dot(d, f.axis_2)};
}

} // namespace FISSURA_ISA
} // namespace fissura::concrete
