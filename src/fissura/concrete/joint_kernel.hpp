#pragma once
// Joint forces, Eqs. 13 and 17 before any damage; joints with a history go to the full law, one by one.
// Included only by the files that are compiled per instruction set.
#include <cstdint>
#include <cstring>

#include "fissura/concrete/kernels.hpp"
#include "fissura/core/pack.hpp"

namespace fissura::concrete {
inline namespace FISSURA_ISA {

using core::load;
using core::Vec;

/// Elastic constants of one pack of joints.
template <class V> struct JointConstants {
  V k, quarter_ft, shear_limit, tan_phi, quarter_fs, weight, look_above;
};

/// Traction at one mid-edge from its jump d; marks in `beyond` the lanes that left the undamaged range.
template <bool rate, class V, class M>
inline Vec<V> intact_traction(JointConstants<V> const& c, Vec<V> d, Vec<V> n, M& beyond) {
  V const zero(0.0), one(1.0), half(0.5);
  V const opening = core::dot(d, n);
  Vec<V> const sliding = d - opening * n;
  V const linear = c.k * opening;
  V const used = linear * c.quarter_ft; // = opening/(2 o_p)
  V const sigma = core::choose(opening > zero, V(linear * (one - used)), linear);
  V const slide = c.k * core::square_root(core::dot(sliding, sliding));
  V const pressure = core::choose(linear < zero, V(-linear), zero);
  if constexpr (rate) beyond = beyond || linear > c.look_above;
  beyond = beyond || used > half || slide > c.shear_limit + c.tan_phi * pressure;
  return sigma * n + V(c.k * (one - slide * c.quarter_fs)) * sliding;
}

template <bool rate, class V> inline void joint_pack(JointPass const& pass, std::size_t b, int lane0) {
  using core::load_nodes;
  constexpr int w = core::lanes<V>;
  int const* const node = pass.joints->node.data() + b * 6 * model::block + lane0;
  double const* const edge = pass.joints->edge.data() + b * 6 * model::block + lane0;
  double const* const e = pass.joints->elastic.data() + b * 6 * model::block + lane0;

  Vec<V> jump[3], mean[3];
  V const half(0.5);
  for (int k = 0; k < 3; ++k) {
    Vec<V> const ua = load_nodes<V>(pass.u, node + k * model::block);
    Vec<V> const ub = load_nodes<V>(pass.u, node + (k + 3) * model::block);
    jump[k] = ub - ua;
    mean[k] = half * (ua + ub);
  }
  // Current mid-triangle: reference edges plus differences of mean displacements, so small jumps lose no
  // digits.
  auto row = [&](int i) { return load<V>(edge + i * model::block); };
  Vec<V> const e1 = Vec<V>{row(0), row(1), row(2)} + (mean[1] - mean[0]);
  Vec<V> const e2 = Vec<V>{row(3), row(4), row(5)} + (mean[2] - mean[0]);
  Vec<V> const area = core::cross(e1, e2);
  Vec<V> const n = V(V(1.0) / core::square_root(core::dot(area, area))) * area;

  auto constant = [&](int i) { return load<V>(e + i * model::block); };
  JointConstants<V> c{constant(0), constant(1), constant(2), constant(3), constant(4), constant(5), V(0.0)};
  if constexpr (rate) c.look_above = load<V>(pass.joints->look_above.data() + b * model::block + lane0);
  auto beyond = V(0.0) > V(1.0);
  Vec<V> const t01 = intact_traction<rate>(c, half * (jump[0] + jump[1]), n, beyond);
  Vec<V> const t12 = intact_traction<rate>(c, half * (jump[1] + jump[2]), n, beyond);
  Vec<V> const t20 = intact_traction<rate>(c, half * (jump[2] + jump[0]), n, beyond);

  std::size_t const first = b * model::block + lane0;
  double* const force = pass.force + 12 * first;
  core::store_nodes<V>(force, 12, c.weight * (t20 + t01));
  core::store_nodes<V>(force + 4, 12, c.weight * (t01 + t12));
  core::store_nodes<V>(force + 8, 12, c.weight * (t12 + t20));

  std::uint8_t const* const status = pass.status + first;
  std::uint8_t marked = 0;
  for (int i = 0; i < w; ++i) marked |= status[i];
  if (!marked && !core::any(beyond)) [[likely]]
    return;
  for (int i = 0; i < w; ++i)
    if (status[i] || core::lane(beyond, i)) pass.damaged(pass.context, static_cast<int>(first) + i);
}

template <class V> void joint_forces(JointPass const& pass, std::size_t begin, std::size_t end) {
  bool const rate = pass.joints->look_above.size() > 0;
  for (std::size_t b = begin; b < end; ++b)
    for (int lane = 0; lane < model::block; lane += core::lanes<V>)
      rate ? joint_pack<true, V>(pass, b, lane) : joint_pack<false, V>(pass, b, lane);
}

} // namespace FISSURA_ISA
} // namespace fissura::concrete
