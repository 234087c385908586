#pragma once
// The two hot loops of the step, compiled once per instruction set and chosen at start.
#include <cstddef>
#include <string_view>

#include "fissura/model/blocks.hpp"
#include "fissura/state/state.hpp"

namespace fissura::concrete {

/// What the joint loops need.
struct JointPass {
  model::JointBlocks const* joints;
  double const* u;
  double* force;
  std::uint8_t const* status;
};

/// What the full law of damaged joints reads and writes.
struct DamagedPass {
  double const* u;
  double const* laws;
  double* force;
};

/// What the tet loop needs beside the state arrays.
struct TetPass {
  model::TetBlocks const* tets;
  double* u;
  double* v;
  state::JointSlots const* joints;
  state::Overlay const* overlay;
  double* corner_force; ///< write the corner forces of the range here and do not integrate; else nullptr
  double dt;
  double mass_damping;  ///< c [1/s]
  double local_damping; ///< alpha [-]
  Vec3 gravity;         ///< acceleration now [m/s2]
  Vec3 gravity_mean;    ///< mean of now and of the next step, for its work
  bool reads_energy;    ///< the whole of the kinetic energy is asked for
};

/// One set of kernels per instruction set; [begin, end) are blocks.
struct KernelSet {
  std::string_view name; ///< "x86-64-v2", "x86-64-v3", "x86-64-v4", or "scalar" (the oracle)
  /// Lists the intact joints that leave the undamaged range, and returns their number.
  int (*joint_forces)(JointPass const&, std::size_t begin, std::size_t end, int* marked);
  double (*intact_joint_energy)(JointPass const&, std::size_t begin, std::size_t end); ///< [J]
  void (*act_batch)(DamagedPass const&, state::JointBatch&,
                    state::HistoryRows&); ///< the full law of damaged joints
  double (*batch_energy)(DamagedPass const&, state::JointBatch const&,
                         state::HistoryRows const&); ///< what they hold [J]
  state::TetSums (*tet_forces)(TetPass const&, std::size_t begin, std::size_t end);
};

/// The best set this machine can run; the environment variable FISSURA_KERNELS=scalar|v2|v3|v4 overrides it.
KernelSet const& kernels();
/// A named set ("scalar", "v2", "v3", "v4"); throws core::Error when the machine cannot run it.
KernelSet const& kernels(std::string_view name);

} // namespace fissura::concrete
