#pragma once
// What a checkpoint holds: each struct of the state is described once, and saving, loading, comparing and the
// search for numbers that are not finite (walk.hpp) all go through that description. A field that is added to
// a struct and not here does not compile: the list takes the struct apart into as many names as it has
// members.
#include <concepts>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "fissura/state/state.hpp"

namespace fissura::checkpoint {

template <class T, class U>
concept Is = std::same_as<std::remove_const_t<T>, U>;

} // namespace fissura::checkpoint

/// fields(x): references to all members of a plain struct, in their order; field_names(x): what they are
/// called, parted by commas. To be used in the namespace of the struct, or in this one for those of the
/// state.
#define FISSURA_FIELDS(Type, ...)                                                                            \
  template <fissura::checkpoint::Is<Type> T> auto fields(T& whole) {                                         \
    auto& [__VA_ARGS__] = whole;                                                                             \
    return std::tie(__VA_ARGS__);                                                                            \
  }                                                                                                          \
  template <fissura::checkpoint::Is<Type> T> constexpr std::string_view field_names(T const& /*of*/) {       \
    return #__VA_ARGS__;                                                                                     \
  }

namespace fissura::checkpoint {

/// Lists whose length is part of the state; all others have the length that the model gives them.
/// (Structs of the driver say so by a type ListGrows of their own.)
template <class Item> inline constexpr bool grows = requires {
  typename Item::ListGrows;
};
template <> inline constexpr bool grows<state::ContactPair> = true;
template <> inline constexpr bool grows<state::RigidTouch> = true;

FISSURA_FIELDS(Vec3, x, y, z)
FISSURA_FIELDS(core::NodeField, values)

FISSURA_FIELDS(laws::CohesiveHistory, kappa, z, f_s, slid_1, slid_2)
FISSURA_FIELDS(laws::Separation, opening, sliding_1, sliding_2)
FISSURA_FIELDS(laws::Dissipation, mode_I, mode_II, friction)
FISSURA_FIELDS(state::JointHistory, point, last, dissipated, handed_over, farthest_squared, time_of_failure)
FISSURA_FIELDS(state::HistoryRows, row)
FISSURA_FIELDS(state::JointHistories, lane, rows)
FISSURA_FIELDS(state::JointRate, sum, weight, last_step, excess, frozen)

FISSURA_FIELDS(laws::BondCurve, strength, eps_y, s_y, ramp, H1, H2, eps_0, s_0)
FISSURA_FIELDS(laws::BondHistory, sigma_cr, curve, s_max, shift, eps_max, K, yielded, closed, s_closed)
FISSURA_FIELDS(laws::Branch, strain, stress, own_1, own_2, left)
FISSURA_FIELDS(laws::BranchList, at, count)
FISSURA_FIELDS(laws::SteelHistory, strain, stress, now, rising, falling, eps_largest, eps_smallest, eps_z,
               direction, ruptured)
FISSURA_FIELDS(laws::DowelHistory, DI, softening, V_max, strength)
FISSURA_FIELDS(laws::BarJointHistory, activated, yielded, ruptured, S_0, t_0, stored_0, bond, steel, dowel, S,
               t_s, sigma, V_s, strain, at_closing)
FISSURA_FIELDS(state::BarJointAccount, bond_steel, dowel, rupture)
FISSURA_FIELDS(state::BarJointMotion, axial, slip_from_start, t_1, t_2, held)
FISSURA_FIELDS(state::BarState, elongation, element_stress, history, motion, account, joint_stress,
               joint_strain, slip, normalised_slip, dowel_force)

FISSURA_FIELDS(state::ContactPair, a, b, energy_at_start, stiffness, stretch)
FISSURA_FIELDS(state::ContactState, pairs, stored, travel, skin, is_due)
FISSURA_FIELDS(state::RigidTouch, tet, face, point, body, offset, stretch)
FISSURA_FIELDS(state::RigidState::Body, u, v, force, impulse)
FISSURA_FIELDS(state::RigidState, body, touch)

FISSURA_FIELDS(state::PathState, target, rising, turned_at, velocity, acceleration, toward)
FISSURA_FIELDS(state::Ledger, work_supports, work_forces, work_gravity, viscous, mass_damping, local_damping,
               contact_friction, absorbed, joint_inertia, start, kinetic_before, absolute_work)
FISSURA_FIELDS(state::State, step, time, stage, u, v, joint_status, joint_history, joint_rate, bars, rigid,
               contact, reaction, prescribed_velocity, held, paths, pace, pace_growth, lead, stage_start,
               ledger)

} // namespace fissura::checkpoint
