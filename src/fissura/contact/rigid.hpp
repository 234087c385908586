#pragma once
// Contact of concrete with rigid planes and impactors (part of F_inter in Eq. 2). Quadrature points on free
// faces of tets (the boundary, and the faces of released joints) are pushed out of a rigid body by springs;
// Coulomb friction acts across. A body is felt at these points only: it must not be small beside the faces.
// Impactors move as point masses that do not turn; rigid bodies do not see each other.
#include <string>
#include <vector>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::contact {

/// Throws core::InputError, one finding per body, where concrete overlaps a rigid body at t = 0 by more than
/// 1e-6 of the tet's size.
void check_rigid_start(model::Model const& m);
/// Bodies that are small beside the faces they may touch.
std::vector<std::string> rigid_warnings(model::Model const& m);

/// The bodies at t = 0; nothing is in touch yet.
state::RigidState make_rigid_state(model::Model const& m);

/// Forces of the rigid bodies at u_n into the overlay and into RigidState::Body::force; the memory of the
/// points in touch moves on and slip is booked to contact_friction. Allocates only when the list of near
/// faces is renewed.
void rigid_forces(model::Model const& m, state::State& s, state::Scratch& w);

struct ImpactorEffects {
  state::Kinetic kinetic; ///< of the impactors
  double gravity = 0;     ///< work of gravity on them over u_n -> u_(n+1) [J]
};
/// Integrates the impactors as Eq. (1) does a node, without damping: v(n-1/2), u(n) -> v(n+1/2), u(n+1).
ImpactorEffects move_impactors(model::Model const& m, state::State& s, Vec3 gravity, Vec3 gravity_mean);

/// Energy in the springs at the last u_n at which forces were found [J].
double rigid_energy(model::Model const& m, state::State const& s);

/// k_n of a face against a body [Pa/m]: p/h of its tet, at most what keeps the step stable
/// (k_n A <= 0.05 m/dt^2, m the tet's mass, for an impactor reduced with the share of its mass that falls to
/// the face).
double rigid_stiffness(model::Model const& m, int tet, double area, model::RigidBody const& body);

} // namespace fissura::contact
