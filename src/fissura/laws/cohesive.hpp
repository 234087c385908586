#pragma once
// Concrete joint at one integration point: tension, compression, shear, friction of the crack faces.
//
// Source: Eqs. 13-19 of the founding paper (13 before the peak, 14-16 softening, 17-18 shear, 19 mixed mode).
// Two laws, equal in pure tension and pure shear: `energy_consistent` (default) follows from a stored energy
// and never creates energy; `paper` is Eqs. 13-19 to the letter with a secant memory and can create energy in
// mixed mode. Parameters: CohesiveInput. History: CohesiveHistory, one per integration point. Misprints: Eq.
// 13 prints o_p = 2 h f_i/p; it is 2 h f_t/p, and the parabola holds for 0 <= opening <= o_p. Theory:
// docs/theory/cohesive.md.

namespace fissura::laws {

enum class CohesiveLaw { energy_consistent, paper };

/// Softening range: exact gives G_f, y3d is the customary 3 G_f/f_t, which dissipates 1.159 G_f.
enum class CohesiveRange { exact, y3d };

/// What the user states about a joint, SI.
struct CohesiveInput {
  double p = 0;              ///< penalty [Pa], > 0
  double h = 0;              ///< element size at the joint [m], > 0
  double f_t = 0;            ///< tensile strength [Pa], > 0
  double G_f = 0;            ///< fracture energy, mode I [J/m2], > 0
  double G_s = 0;            ///< mode II [J/m2]; 0 = G_f
  bool mohr_coulomb = true;  ///< f_s = cohesion - sigma tan(phi) under pressure; false: f_s constant
  double f_s = 0;            ///< constant shear strength [Pa], > 0 without Mohr-Coulomb
  double cohesion = 0;       ///< c [Pa], > 0 with Mohr-Coulomb
  double friction_angle = 0; ///< phi [rad], 0 <= phi < pi/2
  double friction = 0.6;     ///< mu of the crack faces [-], >= 0
  CohesiveLaw law = CohesiveLaw::energy_consistent;
  CohesiveRange range = CohesiveRange::exact;
  bool crackable = true; ///< false: linear elastic for ever
  bool straight = false; ///< straight up to the strength in tension and shear, so that strengths may vary
};

struct CohesiveParams {
  double k = 0;            ///< p/h, initial slope of sigma and tau [Pa/m]
  double f_t = 0;          ///< [Pa]
  double o_p = 0;          ///< opening at the tensile strength, 2 f_t/k (Eq. 13), f_t/k if straight [m]
  double o_r = 0;          ///< softening range of the opening [m]
  double G_f = 0, G_s = 0; ///< [J/m2]
  double f_s = 0;          ///< shear strength without pressure: f_s, or c with Mohr-Coulomb [Pa]
  double tan_phi = 0;      ///< 0 without Mohr-Coulomb
  double friction = 0;     ///< mu
  double shear_work = 0;   ///< s_r f_s [J/m2]: the softening range of the sliding is shear_work/f_s
  bool mohr_coulomb = false;
  bool straight_tension = false, straight_shear = false; ///< shape up to the strength: line or parabola
  CohesiveLaw law = CohesiveLaw::energy_consistent;
  bool crackable = true;

  bool operator==(CohesiveParams const&) const = default;
};

/// Throws core::Error (input) naming the first parameter outside its range.
CohesiveParams make_cohesive_params(CohesiveInput const& input);

/// The joint with strengths f_t and f_s (c with Mohr-Coulomb) times `factor`; fracture energies stay. The
/// undamaged joint must be straight up to its strength: then its energy does not depend on the strength.
CohesiveParams with_strength(CohesiveParams p, double factor) noexcept;

/// The same strengths and fracture energies with the initial slope k.
CohesiveParams with_stiffness(CohesiveParams p, double k) noexcept;

struct CohesiveHistory {
  double kappa = 0;              ///< largest damage D so far; 1 = this point has failed
  double z = 1;                  ///< softening(kappa), kept because exp is dear
  double f_s = 0;                ///< shear strength frozen at first damage [Pa]; 0 = not frozen
  double slid_1 = 0, slid_2 = 0; ///< plastic part of the frictional sliding, tangential axes of the joint [m]
};

/// Jump of displacement across the joint, in its own axes [m].
struct Separation {
  double opening = 0, sliding_1 = 0, sliding_2 = 0;
};
/// Traction in the same axes [Pa]; sigma > 0 is tension.
struct Traction {
  double sigma = 0, tau_1 = 0, tau_2 = 0;
};
/// Energy lost by kind: an increment [J/m2], or an account [J].
struct Dissipation {
  double mode_I = 0, mode_II = 0, friction = 0;
  Dissipation& operator+=(Dissipation const& b) noexcept {
    mode_I += b.mode_I, mode_II += b.mode_II, friction += b.friction;
    return *this;
  }
};

/// Traction at `now` (Eqs. 13-19). Advances the history and adds what the step dissipates [J/m2] to `lost`.
/// `before` is the separation one step earlier. `broken`: all points of the joint have failed and it is a
/// crack-face pair: sigma = k opening under pressure, else 0; Coulomb friction with a tangential spring k.
Traction cohesive_traction(CohesiveParams const& p, CohesiveHistory& history, Separation now,
                           Separation before, bool broken, Dissipation& lost) noexcept;

/// Recoverable energy [J/m2] of a point: normal part, cohesive shear and friction spring; also of undamaged
/// points.
double cohesive_stored(CohesiveParams const& p, CohesiveHistory const& history, Separation now,
                       bool broken) noexcept;

/// Damage D (Eqs. 16, 18, 19), not limited to 1, at a separation for the shear strength that holds there.
double cohesive_damage(CohesiveParams const& p, CohesiveHistory const& history, Separation now) noexcept;

/// Opening o_p + o_r at which a point pulled straight apart has failed (delta_c) [m].
inline double critical_opening(CohesiveParams const& p) noexcept {
  return p.o_p + p.o_r;
}

/// How a point or joint broke, from its dissipated energy.
enum class CrackMode { none, opening, sliding, mixed };
/// Opening or sliding where one of them took at least 80 % of the fracture work (friction does not count).
CrackMode crack_mode(Dissipation const& total) noexcept;

} // namespace fissura::laws
