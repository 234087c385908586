#include "fissura/step/ledger.hpp"

#include "fissura/concrete/concrete.hpp"
#include "fissura/contact/rigid.hpp"
#include "fissura/rebar/rebar.hpp"

namespace fissura::step {

std::array<std::pair<std::string_view, double>, 22> EnergyBalance::accounts() const {
  return {{{"kinetic", kinetic},
           {"strain", strain},
           {"joints", joints},
           {"bars", bars},
           {"bar_joints", bar_joints},
           {"contact", contact},
           {"impactors", impactors},
           {"fracture_I", fracture_I},
           {"fracture_II", fracture_II},
           {"friction", friction},
           {"contact_friction", contact_friction},
           {"bond_steel", bond_steel},
           {"dowel", dowel},
           {"rupture", rupture},
           {"viscous", viscous},
           {"mass_damping", mass_damping},
           {"local_damping", local_damping},
           {"absorbed", absorbed},
           {"joint_inertia", joint_inertia},
           {"work_supports", work_supports},
           {"work_forces", work_forces},
           {"work_gravity", work_gravity}}};
}

EnergyBalance read_stored(model::Model const& m, state::State const& s, state::JointSlots const* slots) {
  EnergyBalance e;
  e.strain = concrete::strain_energy(m, s);
  e.joints = slots ? concrete::joint_energy(m, s, *slots) : concrete::joint_energy(m, s);
  auto const lost = concrete::joint_dissipation(m, s);
  e.fracture_I = lost.mode_I;
  e.fracture_II = lost.mode_II;
  e.friction = lost.friction;
  auto const bars = rebar::bar_energy(m.bars, s.bars);
  e.bars = bars.elements;
  e.bar_joints = bars.joints;
  e.bond_steel = bars.bond_steel;
  e.dowel = bars.dowel;
  e.rupture = bars.rupture;
  e.contact = s.contact.stored + contact::rigid_energy(m, s);
  return e;
}

void read_flows(EnergyBalance& e, model::Model const&, state::State const& s) {
  e.viscous = s.ledger.viscous;
  e.mass_damping = s.ledger.mass_damping;
  e.local_damping = s.ledger.local_damping;
  e.contact_friction = s.ledger.contact_friction;
  e.absorbed = s.ledger.absorbed;
  e.joint_inertia = s.ledger.joint_inertia;
  e.work_supports = s.ledger.work_supports;
  e.work_forces = s.ledger.work_forces;
  e.work_gravity = s.ledger.work_gravity;
  e.absolute_work = s.ledger.absolute_work;
  e.start = s.ledger.start;
}

} // namespace fissura::step
