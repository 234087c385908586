#pragma once
// What the full law asks of damaged joints beside their histories, eight side by side.
#include <array>

#include "fissura/model/blocks.hpp"

namespace fissura::state {

/// The lanes of one HistoryRows. They stay as they are from step to step; only what has just happened to a
/// joint changes them.
struct alignas(64) JointBatch {
  static constexpr int width = model::block;
  using Row = std::array<double, width>;
  using Starts = std::array<int, width>; ///< where the data of each joint start, in doubles

  int count;       ///< joints in the batch; the lanes behind them are idle
  bool needs_care; ///< something that is rare has to be done to a joint in each step
  bool has_one_law;
  bool has_event; ///< result: some joint has got its first damage, failed, or moved far
  std::array<int, width> joint;
  std::array<Starts, 6> node;                   ///< a0 a1 a2 b0 b1 b2 in nodal arrays
  std::array<std::array<float, width>, 6> edge; ///< reference edges 0->1, 0->2 [m]
  Starts force_a, force_b;                      ///< in JointSlots::force
  Starts law;                                   ///< in JointSlots::laws
  Row k, per_k, weight;                         ///< [Pa/m]; [m/Pa]; area/6 [m2]
  Row strength;                                 ///< factor on the strengths, by the strain rate
  Row broken;                                   ///< 1 for crack-face pairs
  Row damaged, failed; ///< before and after: 1 where some point has damage, where all points have failed
};

/// The joint laws that occur, as packs read them: twelve doubles each, f_t o_r f_s tan_phi | friction
/// shear_work 1/shear_work 1/o_r | mohr_coulomb straight_tension straight_shear paper.
inline constexpr int doubles_per_law = 12;

} // namespace fissura::state
