#pragma once
// Who is in which lane: histories (state::JointHistories) and batches (state::JointBatch) of one group of
// joints.
#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::concrete {

/// Tells the batch of a lane what the law asks of a joint, and that it needs care.
void fill_lane(model::Model const& m, state::State const& s, state::JointSlots& slots, int lane, int joint);
/// Lets the batches of a group know that this many of its lanes are taken. What remains of the last batch is
/// idle: a joint between a face and itself, which nothing opens.
void set_taken(state::JointSlots& slots, std::size_t group, int taken);

/// The lanes of a group while they change hands.
struct JointLanes {
  model::Model const& m;
  state::State& s;
  state::JointSlots& slots;
  std::size_t group;

  state::LaneCounts& counts() const { return slots.lanes[group]; }
  std::size_t row(int lane) const { return state::JointHistories::place(group, lane) / model::block; }
  state::JointBatch& batch(int lane) const { return slots.batches[row(lane)]; }
  int joint(int lane) const { return batch(lane).joint[static_cast<std::size_t>(lane % model::block)]; }

  /// Lets a joint take a lane that is free.
  void take(int lane, int joint, state::JointHistory const& history) const;
  /// Forgets what is in a lane.
  void clear(int lane) const;
  /// Lets the joint in one lane take another that is free.
  void move(int from, int to) const;
  /// A released joint leaves for the far end, and the last one at work takes its lane.
  void retire(int lane) const;
};

} // namespace fissura::concrete
