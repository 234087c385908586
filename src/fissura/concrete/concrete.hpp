#pragma once
// The concrete's terms of Eq. (2): joints (F_conc,JE), tets (F_conc,FE), and the energy they hold.
#include <functional>
#include <span>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::concrete {

/// Slots for the forces of all joints, as the state of each demands.
state::JointSlots make_joint_slots(model::Model const& m, state::State const& s);
/// Gives side b of a joint a slot of its own: its force is no longer the opposite of side a's.
void separate_sides(model::Model const& m, state::JointSlots& slots, int joint);
/// A released joint acts on nobody.
void remove_from_slots(model::Model const& m, state::JointSlots& slots, int joint);

/// Gets the forces [N] on the nodes from `first` on, laid out as State::u.
using TakeForces = std::function<void(std::size_t first, std::span<double const> forces)>;
/// Internal forces on the nodes at u and v, with the joint forces and the overlay that `w` holds; nothing
/// moves. They are handed on piece by piece, by several threads at once, so that nobody needs room for all.
void corner_forces(model::Model const& m, state::State& s, state::Scratch const& w, TakeForces const& take);

/// Gives all three points of a joint the damage kappa, as if it had been pulled open and let go; 1 breaks it.
void set_damage(model::Model const& m, state::State& s, int joint, double kappa);

/// F_conc,JE at u_n: tractions of all joints into their slots; histories and dissipation move on.
void joint_forces(model::Model const& m, state::State& s, state::Scratch& w);

/// F_conc,FE at u_n, gather of joint forces and overlay, damping, Eq. (1): v(n-1/2), u(n) -> v(n+1/2),
/// u(n+1). Gravity acts with `gravity`; `gravity_mean` (now and next step) gives its work. Returns what the
/// step dissipated; the kinetic energy whole only with `reads_energy`.
state::TetSums tet_forces_and_integrate(model::Model const& m, state::State& s, state::Scratch& w,
                                        Vec3 gravity, Vec3 gravity_mean, bool reads_energy = false);

/// The same forces of the blocks [begin, end) into Scratch::corner_force; nothing moves. Not parallel: the
/// caller gives each thread its blocks.
state::TetSums tet_forces(model::Model const& m, state::State& s, state::Scratch& w, std::size_t begin,
                          std::size_t end);

/// Elastic energy in the tets at u [J].
double strain_energy(model::Model const& m, state::State const& s);
/// Recoverable energy in the joints at u [J].
double joint_energy(model::Model const& m, state::State const& s);
/// The same, in packs, from what the last joint_forces at this u has left in the slots.
double joint_energy(model::Model const& m, state::State const& s, state::JointSlots const& slots);
/// What the joints have dissipated so far [J].
laws::Dissipation joint_dissipation(model::Model const& m, state::State const& s);

/// Separation of a joint at its three points, in its current frame (normal from a to b).
struct JointKinematics {
  Vec3 normal, axis_1, axis_2;
  std::array<Vec3, 3> jump;           ///< of the node pairs [m]
  std::array<Vec3, 3> mid;            ///< corners of the mid-triangle, seen from the first [m]
  std::array<laws::Separation, 3> at; ///< mid-edges 01, 12, 20
};
/// From the displacements u - back * v (back = 0: now; back = dt: one step ago).
JointKinematics joint_kinematics(model::Model const& m, state::State const& s, int joint, double back = 0);

/// Cauchy stress of a tet: xx yy zz xy yz zx [Pa], elastic part.
std::array<double, 6> tet_stress(model::Model const& m, state::State const& s, int tet);
/// Gradient of a nodal field (displacements, velocities) in a tet, over the reference positions.
Mat3 gradient_in(model::Model const& m, core::NodeField const& field, int tet);
/// Deformation gradient of a tet minus the identity.
Mat3 displacement_gradient(model::Model const& m, state::State const& s, int tet);

struct JointCounts {
  int damaged = 0;  ///< some point has passed its strength; includes the following
  int cracked = 0;  ///< all three points have passed it: a crack crosses the joint
  int broken = 0;   ///< all three points have failed: no cohesion left
  int released = 0; ///< broken, and its faces no longer lie against each other
};
JointCounts count_joints(model::Model const& m, state::State const& s);

} // namespace fissura::concrete
