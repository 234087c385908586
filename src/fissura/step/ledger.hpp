#pragma once
// Every joule has a named account.
#include <array>
#include <string_view>
#include <utility>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::step {

/// One reading of the ledger at step n [J].
struct EnergyBalance {
  double kinetic = 0, strain = 0, joints = 0, bars = 0, bar_joints = 0, contact = 0,
         impactors = 0; ///< held now; impactors: the kinetic energy of rigid impactors
  double fracture_I = 0, fracture_II = 0, friction = 0, contact_friction = 0, bond_steel = 0, dowel = 0,
         rupture = 0; ///< dissipated; friction: in joints, contact_friction: outside them
  double viscous = 0, mass_damping = 0, local_damping = 0, absorbed = 0, joint_inertia = 0; ///< dissipated
  double work_supports = 0, work_forces = 0, work_gravity = 0;                              ///< put in
  double absolute_work = 0, start = 0;

  double held() const { return kinetic + impactors + internal(); }
  double internal() const { return strain + joints + bars + bar_joints + contact; }
  double dissipated() const {
    return fracture_I + fracture_II + friction + contact_friction + bond_steel + dowel + rupture + viscous +
           mass_damping + local_damping + absorbed + joint_inertia;
  }
  double work() const { return work_supports + work_forces + work_gravity; }
  /// Signed: negative = more energy than was put in.
  double missing() const { return start + work() - held() - dissipated(); }

  /// Accounts by name, in the order of run.json and history.csv.
  std::array<std::pair<std::string_view, double>, 22> accounts() const;
};

/// Stored energies at u_n (before the nodes move on); the kinetic energy is added by the step. Faster with
/// the slots of joints whose forces are those at u_n.
EnergyBalance read_stored(model::Model const& m, state::State const& s,
                          state::JointSlots const* slots = nullptr);
/// Completes a reading with the work and the dissipation up to u_n.
void read_flows(EnergyBalance& e, model::Model const& m, state::State const& s);

} // namespace fissura::step
