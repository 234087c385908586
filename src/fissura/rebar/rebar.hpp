#pragma once
// The reinforcement's terms of Eq. (2): bar joints (F_rc,JE, Eqs. 20-27), bar elements (F_rc,FE, Eqs. 3-5),
// their energy and their share in the stable step. Theory: docs/theory/bars.md. Every pass writes each result
// once, from one index: the same bits on any number of threads. Nothing here allocates after
// make_bar_scratch.
#include <cstddef>
#include <span>

#include "fissura/model/model.hpp"
#include "fissura/rebar/embed.hpp"
#include "fissura/state/state.hpp"

namespace fissura::rebar {

/// Fills in Bars::joint_law and Bars::settings from the concretes, the joints' laws and the bar settings of
/// the model; call once after embedding, when mesh, material_of_tet, joints and bars of the model are there.
/// Throws core::InputError at the bar's place for parameters the laws refuse.
void set_bar_joint_laws(model::Model& m);

/// All bars at rest.
state::BarState make_bar_state(model::Bars const& bars);

/// Lets all bar joints that can crack slip from now on, as if a crack crossed each.
void activate_all(model::Model const& m, state::BarState& s);

/// Work arrays; every host tet of a bar must own a slot of the overlay.
state::BarScratch make_bar_scratch(model::Model const& m, state::Overlay const& overlay);

/// What the slip of activated bar joints is counted by. In a run: the path, step by step from the velocities
/// at n - 1/2 (docs/theory/bar_joint.md, "Slip along the path"). For trial motions about the state at rest,
/// where both are the same: the positions.
enum class SlipBy { path, positions };

/// F_rc,JE at u_n: stretch of all elements, then stress, dowel action and history of all bar joints.
void bar_joint_forces(model::Model const& m, state::State& s, state::Scratch& w, SlipBy by = SlipBy::path);
/// F_rc,FE at u_n: axial forces of all elements; after bar_joint_forces, whose forces it may need.
void bar_forces(model::Model const& m, state::State& s, state::Scratch& w);
/// Adds the forces of elements and joints to the overlay, tet by tet in a fixed order.
void gather_bar_forces(model::Model const& m, state::Scratch& w);

/// Where the energy of the reinforcement is [J].
struct BarEnergy {
  double elements = 0;   ///< held in bar elements
  double joints = 0;     ///< held in bar joints: axial and dowel springs
  double bond_steel = 0; ///< lost to bond slip and yielding
  double dowel = 0;      ///< lost in the dowel zone
  double rupture = 0;    ///< released where bars broke
};
BarEnergy bar_energy(model::Bars const& bars, state::BarState const& state);

/// Adds to stiffness[4 tet + corner] [N/m] what the bars contribute to sum_a of omega^2 = (2/m_a) sum_a:
/// lambda_a k_b of the bar joints, k_b = max of the intact and of the activated stiffness, and of the bar
/// elements half the row sum of their stiffness matrix.
void add_bar_stiffness(model::Bars const& bars, std::span<double> stiffness);

} // namespace fissura::rebar
