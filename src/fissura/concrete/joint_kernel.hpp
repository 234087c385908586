#pragma once
// Joint forces, Eqs. 13 and 17 before any damage; joints that leave that range are listed for the full law.
// Included only by the files that are compiled per instruction set.
#include <cstdint>
#include <cstring>

#include "fissura/concrete/joint_frame.hpp"
#include "fissura/concrete/kernels.hpp"

namespace fissura::concrete {
inline namespace FISSURA_ISA {

using core::load;
using core::Vec;

/// Elastic constants of one pack of joints.
template <class V> struct JointConstants {
  V k, weight, quarter_ft, shear_limit, tan_phi, quarter_fs, look_above;
};
template <class V>
inline JointConstants<V> constants_of(model::JointBlocks const& joints, std::size_t b, int lane0) {
  auto own = [&](int i) { return load<V>(joints.stiffness.data() + (2 * b + i) * model::block + lane0); };
  auto limit = [&](int i) { return load<V>(joints.limits.of_block(b) + i * model::block + lane0); };
  return {own(0), own(1), limit(0), limit(1), limit(2), limit(3), limit(4)};
}

/// Traction at one mid-edge from its jump d; marks in `beyond` the lanes that left the undamaged range.
template <bool rate, class V, class M>
inline Vec<V> intact_traction(JointConstants<V> const& c, Vec<V> d, Vec<V> n, M& beyond) {
  V const zero(0.0), one(1.0), half(0.5);
  V const opening = core::dot(d, n);
  Vec<V> const sliding = d - opening * n;
  V const linear = c.k * opening;
  V const used = linear * c.quarter_ft; // = opening/(2 o_p)
  V const sigma = core::choose(opening > zero, V(linear * (one - used)), linear);
  V const slide_2 = c.k * c.k * core::dot(sliding, sliding);
  V const pressure = core::choose(linear < zero, V(-linear), zero);
  if constexpr (rate) beyond = beyond || linear > c.look_above;
  V const limit = c.shear_limit + c.tan_phi * pressure;
  beyond = beyond || used > half || slide_2 > limit * limit;
  V slope = c.k;
  if (core::any(c.quarter_fs > zero)) slope = c.k * (one - core::square_root(slide_2) * c.quarter_fs);
  return sigma * n + slope * sliding;
}

template <class V> inline JointFrame<V> frame_of(JointPass const& pass, std::size_t b, int lane0) {
  int const* const node = pass.joints->node.data() + b * 6 * model::block + lane0;
  float const* const edge = pass.joints->edge.data() + b * 6 * model::block + lane0;
  Vec<V> on_a[3], on_b[3];
  for (int k = 0; k < 3; ++k) {
    on_a[k] = core::load_vectors<V>(pass.u, node + k * model::block);
    on_b[k] = core::load_vectors<V>(pass.u, node + (k + 3) * model::block);
  }
  auto row = [&](int i) { return load<V>(edge + i * model::block); };
  return joint_frame<V>(on_a, on_b, {row(0), row(1), row(2)}, {row(3), row(4), row(5)});
}

/// Fetches what the next packs of a range need, two blocks ahead: the slots of the forces, to be written, and
/// side b, which may lie anywhere (side a comes along in order). Always inline: see prefetch_block of the
/// tets.
[[gnu::always_inline]] inline void prefetch_joints(JointPass const& pass, std::size_t b, std::size_t end) {
  constexpr std::size_t ahead = 2, line = 8; // doubles of a cache line
  if (b + ahead >= end) return;
  std::size_t const slots = state::JointSlots::per_slot * model::block;
  for (std::size_t i = slots * (b + ahead); i < slots * (b + ahead + 1); i += line)
    __builtin_prefetch(pass.force + i, core::to_write);
  int const* const node = pass.joints->node.data() + ((b + ahead) * 6 + 3) * model::block;
  for (int i = 0; i < model::block; ++i) {
    double const* const tet = pass.u + (node[i] - node[i] % core::per_tet);
    __builtin_prefetch(tet);
    __builtin_prefetch(tet + line); // it spans two lines
  }
}

/// Which of its intact joints a pack has to leave to the full law.
struct MarkedJoints {
  int* list;
  int count = 0;

  void add_if(bool is_marked, int joint) {
    list[count] = joint;
    count += is_marked;
  }
};

template <bool rate, class V>
inline void joint_pack(JointPass const& pass, std::size_t b, int lane0, MarkedJoints& marked) {
  constexpr int w = core::lanes<V>;
  std::size_t const first = b * model::block + lane0;
  std::uint8_t const* const status = pass.status + first;
  auto const is_intact = load<V>(status) == V(0.0);
  if (!core::any(is_intact)) return;
  auto const f = frame_of<V>(pass, b, lane0);
  auto const c = constants_of<V>(*pass.joints, b, lane0);
  auto beyond = V(0.0) > V(1.0);
  Vec<V> const t01 = intact_traction<rate>(c, jump_at(f, 0), f.normal, beyond);
  Vec<V> const t12 = intact_traction<rate>(c, jump_at(f, 1), f.normal, beyond);
  Vec<V> const t20 = intact_traction<rate>(c, jump_at(f, 2), f.normal, beyond);

  constexpr int per_slot = state::JointSlots::per_slot;
  int start[w];
  for (int i = 0; i < w; ++i) start[i] = per_slot * i;
  core::store_three<V>(pass.force + per_slot * first, start,
                       {c.weight * (t20 + t01), c.weight * (t01 + t12), c.weight * (t12 + t20)});
  beyond = beyond && is_intact;
  if (!core::any(beyond)) [[likely]]
    return;
  for (int i = 0; i < w; ++i) marked.add_if(core::lane(beyond, i), static_cast<int>(first) + i);
}

/// Energy that undamaged joints hold [J]; leaves out all others.
template <class V> inline V intact_energy(JointPass const& pass, std::size_t b, int lane0) {
  auto const f = frame_of<V>(pass, b, lane0);
  auto const c = constants_of<V>(*pass.joints, b, lane0);
  V const zero(0.0), half(0.5), third(1.0 / 3);
  V sum = zero;
  for (int q = 0; q < 3; ++q) {
    Vec<V> const d = jump_at(f, q);
    V const opening = core::dot(d, f.normal), open = core::larger(opening, zero);
    Vec<V> const sliding = d - opening * f.normal;
    V const square = core::dot(sliding, sliding), slide = core::square_root(square);
    sum = sum + c.k * (opening * opening * (half - third * c.k * c.quarter_ft * open) +
                       square * (half - third * c.k * c.quarter_fs * slide));
  }
  double is_intact[core::lanes<V>];
  for (int i = 0; i < core::lanes<V>; ++i) is_intact[i] = pass.status[b * model::block + lane0 + i] == 0;
  return V(2.0) * load<V>(is_intact) * c.weight * sum; // area/3 per point
}

template <class V> double intact_joint_energy(JointPass const& pass, std::size_t begin, std::size_t end) {
  V sum(0.0);
  for (std::size_t b = begin; b < end; ++b)
    for (int lane = 0; lane < model::block; lane += core::lanes<V>)
      sum = sum + intact_energy<V>(pass, b, lane);
  return core::sum_lanes(sum);
}

template <class V> int joint_forces(JointPass const& pass, std::size_t begin, std::size_t end, int* list) {
  bool const rate = pass.joints->any_rate;
  MarkedJoints marked{list};
  for (std::size_t b = begin; b < end; ++b) {
    prefetch_joints(pass, b, end);
    for (int lane = 0; lane < model::block; lane += core::lanes<V>)
      rate ? joint_pack<true, V>(pass, b, lane, marked) : joint_pack<false, V>(pass, b, lane, marked);
  }
  return marked.count;
}

} // namespace FISSURA_ISA
} // namespace fissura::concrete
