#pragma once
// A bar across an open crack: slip -> strain -> stress along the bar, dowel force across it, rupture, energy.
//
// Source: Eqs. 20-27 of the founding paper, composed from bond_slip, steel and dowel.
// Parameters: BarJointInput. History: BarJointHistory. Misprints: see the parts. Theory:
// docs/theory/bar_joint.md.
#include "fissura/core/vec3.hpp"
#include "fissura/laws/bond_slip.hpp"
#include "fissura/laws/dowel.hpp"
#include "fissura/laws/steel.hpp"

namespace fissura::laws {

struct BarJointInput {
  double D = 0;   ///< bar diameter [m]
  double A_s = 0; ///< steel area [m2]
  SteelParams steel;
  double f_c = 0; ///< compressive strength of the concrete [Pa]
  double l_cr =
      0;          ///< the paper's reduction: distance to the next crack [m]; 0: the consistent one, which has
  double l_g = 0; ///< the length of bar that each face of the crack stands for [m], and
  double l_b = 0; ///< half the distance of cracks [m]
  bool dowel = true;
};

struct BarJointParams {
  double D = 0, A_s = 0;
  SteelParams steel;
  BondParams bond;
  DowelParams dowel;
  bool with_dowel = true;
  double energy_factor = 0; ///< A_s D/(K_fc E_s): recoverable energy per slope and stress squared [J/Pa2]
};

/// Throws core::Error (input) naming the first parameter outside its range.
BarJointParams make_bar_joint_params(BarJointInput const& input);

struct BarJointHistory {
  bool activated = false, yielded = false, ruptured = false;
  double S_0 = 0;      ///< half separation along the bar at activation, to be subtracted by the caller [m]
  Vec3 t_0{};          ///< transverse half slip at activation, to be subtracted by the caller [m]
  double stored_0 = 0; ///< energy at activation [J]
  BondHistory bond;    ///< holds sigma_cr
  SteelHistory steel;
  DowelHistory dowel;
  double S = 0, t_s = 0; ///< last evaluation [m]
  double sigma = 0;      ///< stress of the bar at the crack [Pa]
  double V_s = 0;        ///< dowel force [N]
  double strain = 0;     ///< strain of the bar at the crack
  double at_closing = 0; ///< in a closed crack: its stress once the slip of closing is reached again [Pa]
};

struct BarJointForce {
  double sigma = 0; ///< [Pa]; the force sigma A_s acts along the bar
  double V_s = 0;   ///< [N], along the transverse slip
};

/// Energy lost [J].
struct BarJointDissipation {
  double bond_steel = 0, dowel = 0;
};

/// The crack has opened: remember the step before. `stored` is the energy of the uncracked joint then [J].
/// Returns the energy lost [J]: none, unless the bar was stressed beyond its yield stress (prestress, and the
/// concrete's strain on top), which its steel drops to.
double activate(BarJointParams const& p, BarJointHistory& h, double S_0, Vec3 t_0, double sigma_cr,
                double stored) noexcept;

/// Forces at the slip S and the length t_s of the transverse half slip, both counted from activation [m];
/// `touching`: the faces of the crack touch. Advances the history and adds what the step dissipates [J] to
/// `lost`. A ruptured joint carries nothing.
BarJointForce bar_joint_force(BarJointParams const& p, BarJointHistory& h, double S, double t_s,
                              BarJointDissipation& lost, bool touching = false) noexcept;

/// Energy along the bar [J] at the last evaluation: the one at activation, and what unloading along the
/// current line would give back beyond that. Its change on the elastic line is the work of A_s sigma over 2
/// S.
double bar_joint_axial_stored(BarJointParams const& p, BarJointHistory const& h) noexcept;
/// Axial and dowel energy [J] at the last evaluation.
double bar_joint_stored(BarJointParams const& p, BarJointHistory const& h) noexcept;

/// Largest slope of the axial force over the separation d.r [N/m] once activated, for the stable step.
inline double bar_joint_stiffness_bound(BarJointParams const& p) noexcept {
  return 0.5 * p.steel.E_s * p.A_s * p.bond.normalise / p.bond.k_e;
}

} // namespace fissura::laws
