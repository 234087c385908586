#include "fissura/laws/cohesive.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "fissura/core/error.hpp"
#include "fissura/laws/softening.hpp"

namespace fissura::laws {

namespace {

/// Damage over which the parabola of Eq. 13 turns into a straight secant (energy_consistent).
constexpr double straightening = 0.05;

/// The shape of both branches at a given damage and shear strength: all that depends on the history.
struct Branches {
  double kappa;
  double z;                 ///< share of strength left
  double f_s;               ///< [Pa]
  double s_p;               ///< sliding at the shear strength [m]
  double s_r;               ///< softening range of the sliding [m]
  double o_m;               ///< largest opening the damage stands for [m]
  double s_m;               ///< largest sliding [m]
  double w_normal, w_shear; ///< 0 parabola ... 1 straight line
};

double length(double a, double b) {
  return std::sqrt(a * a + b * b);
}
double length(Separation s) {
  return length(s.sliding_1, s.sliding_2);
}

Separation middle(Separation a, Separation b) {
  return {0.5 * (a.opening + b.opening), 0.5 * (a.sliding_1 + b.sliding_1),
          0.5 * (a.sliding_2 + b.sliding_2)};
}

double shear_strength(CohesiveParams const& p, CohesiveHistory const& h, double opening) {
  if (h.f_s > 0) return h.f_s;
  return opening < 0 ? p.f_s - p.k * opening * p.tan_phi : p.f_s;
}

/// Sliding at the strength: the parabola of Eq. 13 carried over to shear, or a straight line where the
/// strength depends on the pressure or the strain rate (a parabola would not be conservative).
double peak_sliding(CohesiveParams const& p, double f_s) {
  return (p.straight_shear ? 1 : 2) * f_s / p.k;
}

double damage_at(CohesiveParams const& p, double f_s, double opening, double sliding) {
  double const dt = std::max(0.0, (opening - p.o_p) / p.o_r);
  double const excess = sliding - peak_sliding(p, f_s);
  if (excess <= 0) return dt;
  return length(dt, excess * f_s / p.shear_work);
}

Branches branches(CohesiveParams const& p, double kappa, double z, double f_s) {
  Branches b;
  b.kappa = kappa;
  b.z = z;
  b.f_s = f_s;
  b.s_p = peak_sliding(p, f_s);
  b.s_r = p.shear_work / f_s;
  b.o_m = p.o_p + kappa * p.o_r;
  b.s_m = b.s_p + kappa * b.s_r;
  double const w = std::min(1.0, kappa / straightening);
  b.w_normal = p.straight_tension ? 1 : w;
  b.w_shear = p.straight_shear ? 1 : w;
  return b;
}

// ---- energy_consistent: psi = z f m Phi(x), x = separation/m
// ---------------------------------------------------

double stress_shape(double w, double x) {
  return ((2 - w) - (1 - w) * x) * x;
} // G(x)
double energy_shape(double w, double x) {
  return ((2 - w) / 2 - (1 - w) / 3 * x) * x * x;
} // its integral

// ---- paper: Eq. 13 below the peak, secant to the origin below the largest separation ----------------------

double virgin_shape(bool straight, double x) {
  return x >= 1 ? 1 : straight ? x : (2 - x) * x;
} // g(r)
double virgin_energy(bool straight, double x) {
  return straight ? x * x / 2 : (1 - x / 3) * x * x;
}

/// Work of unloading along the secant to the origin, with the other separation held at zero.
double secant_energy(double strength, double peak, double largest, bool straight, double separation) {
  double const below = std::min(separation, peak);
  double const beyond = separation > peak ? 0.5 * (separation * separation - peak * peak) : 0;
  return strength / largest * (peak * peak * virgin_energy(straight, below / peak) + beyond);
}

// ---- both
// -----------------------------------------------------------------------------------------------------

double normal_energy(CohesiveParams const& p, Branches const& b, double opening) {
  if (opening < 0) return 0.5 * p.k * opening * opening;
  if (p.law == CohesiveLaw::paper)
    return secant_energy(b.z * p.f_t, p.o_p, b.o_m, p.straight_tension, opening);
  return b.z * p.f_t * b.o_m * energy_shape(b.w_normal, opening / b.o_m);
}

double shear_energy(CohesiveParams const& p, Branches const& b, double sliding) {
  if (p.law == CohesiveLaw::paper) return secant_energy(b.z * b.f_s, b.s_p, b.s_m, p.straight_shear, sliding);
  return b.z * b.f_s * b.s_m * energy_shape(b.w_shear, sliding / b.s_m);
}

Traction along(Separation at, double sliding, double sigma, double tau) {
  double const ratio = sliding > 0 ? tau / sliding : 0;
  return {sigma, ratio * at.sliding_1, ratio * at.sliding_2};
}

Traction consistent_traction(CohesiveParams const& p, Branches const& b, Separation at, double sliding) {
  double const sigma =
      at.opening < 0 ? p.k * at.opening : b.z * p.f_t * stress_shape(b.w_normal, at.opening / b.o_m);
  return along(at, sliding, sigma, b.z * b.f_s * stress_shape(b.w_shear, sliding / b.s_m));
}

Traction paper_traction(CohesiveParams const& p, Branches const& b, Separation at, double sliding) {
  double const d = std::min(b.kappa, damage_at(p, b.f_s, at.opening, sliding));
  double const sigma = at.opening < 0 ? p.k * at.opening
                                      : b.z * p.f_t * virgin_shape(p.straight_tension, at.opening / p.o_p) *
                                            ((p.o_p + d * p.o_r) / b.o_m);
  double const tau =
      b.z * b.f_s * virgin_shape(p.straight_shear, sliding / b.s_p) * ((b.s_p + d * b.s_r) / b.s_m);
  return along(at, sliding, sigma, tau);
}

Traction cohesive_part(CohesiveParams const& p, Branches const& b, Separation at) {
  double const sliding = length(at);
  return p.law == CohesiveLaw::paper ? paper_traction(p, b, at, sliding)
                                     : consistent_traction(p, b, at, sliding);
}

/// Stiffness of the friction spring [Pa/m]: what the cohesive secant leaves of k, so that both together never
/// exceed the k that the stable step knows. k itself once cohesion is gone.
double friction_stiffness(CohesiveParams const& p, Branches const& b) {
  return p.k * (1 - b.z * b.s_p / b.s_m);
}

/// Coulomb friction with a spring in parallel to the cohesive part; |t| <= (1 - z) mu |sigma|. Adds to `t`.
void add_friction(CohesiveParams const& p, Branches const& old, Branches const& b, CohesiveHistory& h,
                  Separation now, Separation before, Traction& t, Dissipation& lost) {
  double const k_old = friction_stiffness(p, old), k = friction_stiffness(p, b);
  if (!(k > 0)) {
    h.slip_1 = now.sliding_1, h.slip_2 = now.sliding_2;
    return;
  }
  double const e_1 = before.sliding_1 - h.slip_1, e_2 = before.sliding_2 - h.slip_2;
  double const t0_1 = k_old * e_1, t0_2 = k_old * e_2;
  // The spring has stiffened with damage: keep its force, not its stretch, or energy would appear.
  double const keep = std::min(1.0, k_old / k);
  lost.friction += 0.5 * (1 - keep) * (t0_1 * e_1 + t0_2 * e_2);
  double const from_1 = before.sliding_1 - keep * e_1, from_2 = before.sliding_2 - keep * e_2;

  double t_1 = k * (now.sliding_1 - from_1), t_2 = k * (now.sliding_2 - from_2);
  double const limit = t.sigma < 0 ? (1 - b.z) * p.friction * -t.sigma : 0;
  double const size = length(t_1, t_2);
  if (size > limit) {
    t_1 *= limit / size, t_2 *= limit / size;
    h.slip_1 = now.sliding_1 - t_1 / k, h.slip_2 = now.sliding_2 - t_2 / k;
    // Mean traction times slip: exact for the trapezoidal work of the step. Where a step turns the force
    // right round while the pressure falls, the mean may oppose the slip; friction never gives energy back.
    lost.friction +=
        std::max(0.0, 0.5 * ((t0_1 + t_1) * (h.slip_1 - from_1) + (t0_2 + t_2) * (h.slip_2 - from_2)));
  } else {
    h.slip_1 = from_1, h.slip_2 = from_2;
  }
  t.tau_1 += t_1, t.tau_2 += t_2;
}

bool has_friction(CohesiveParams const& p, bool broken) {
  return broken || p.mohr_coulomb;
}

Traction undamaged_traction(CohesiveParams const& p, Separation at) {
  double const o = at.opening, sliding = length(at);
  double const sigma = o < 0 || p.straight_tension ? p.k * o : p.k * o * (1 - 0.5 * o / p.o_p);
  double const slope = p.straight_shear ? p.k : p.k * (1 - 0.25 * p.k * sliding / p.f_s);
  return {sigma, slope * at.sliding_1, slope * at.sliding_2};
}

void require(bool ok, char const* what) {
  if (!ok) throw core::Error(core::Failure::input, std::string("cohesive joint: ") + what);
}

} // namespace

CohesiveParams make_cohesive_params(CohesiveInput const& in) {
  require(in.p > 0, "the penalty p must be positive");
  require(in.h > 0, "the element size h must be positive");
  CohesiveParams out;
  out.k = in.p / in.h;
  out.law = in.law;
  out.crackable = in.crackable;
  out.friction = in.friction;
  if (!in.crackable) return out; // strengths mean nothing to a joint that never cracks
  require(in.f_t > 0, "the tensile strength f_t must be positive");
  require(in.G_f > 0, "the fracture energy G_f must be positive");
  require(in.G_s >= 0, "the fracture energy G_s must not be negative");
  require(in.friction >= 0, "the friction mu must not be negative");
  if (in.mohr_coulomb) {
    require(in.cohesion > 0, "the cohesion c must be positive");
    require(in.friction_angle >= 0 && in.friction_angle < 1.57,
            "the friction angle must lie in [0, 90 degrees)");
  } else {
    require(in.f_s > 0, "the shear strength f_s must be positive");
  }
  double const range = in.range == CohesiveRange::exact ? 1 / softening_integral : 3;
  out.f_t = in.f_t;
  out.straight_tension = in.straight;
  out.straight_shear = in.straight || in.mohr_coulomb;
  out.o_p = (in.straight ? 1 : 2) * in.f_t / out.k;
  out.o_r = range * in.G_f / in.f_t;
  out.G_f = in.G_f;
  out.G_s = in.G_s > 0 ? in.G_s : in.G_f;
  out.mohr_coulomb = in.mohr_coulomb;
  out.f_s = in.mohr_coulomb ? in.cohesion : in.f_s;
  out.tan_phi = in.mohr_coulomb ? std::tan(in.friction_angle) : 0;
  out.shear_work = range * out.G_s;
  return out;
}

CohesiveParams with_strength(CohesiveParams p, double factor) noexcept {
  p.f_t *= factor;
  p.f_s *= factor;
  p.o_p *= factor;
  p.o_r /= factor;
  return p;
}

double cohesive_damage(CohesiveParams const& p, CohesiveHistory const& h, Separation now) noexcept {
  return p.crackable ? damage_at(p, shear_strength(p, h, now.opening), now.opening, length(now)) : 0;
}

Traction cohesive_traction(CohesiveParams const& p, CohesiveHistory& h, Separation now, Separation before,
                           bool broken, Dissipation& lost) noexcept {
  if (!p.crackable) return {p.k * now.opening, p.k * now.sliding_1, p.k * now.sliding_2};
  double const f_s = shear_strength(p, h, now.opening);
  double const kappa_old = h.kappa;
  double const damage = broken ? 1 : std::min(1.0, damage_at(p, f_s, now.opening, length(now)));
  h.kappa = std::max(kappa_old, damage);
  if (h.kappa <= 0) return undamaged_traction(p, now);
  if (kappa_old <= 0) {
    if (p.mohr_coulomb) h.f_s = f_s;
    h.slip_1 = before.sliding_1, h.slip_2 = before.sliding_2; // friction starts without a jump
  }
  Branches const old = branches(p, kappa_old, kappa_old > 0 ? h.z : 1, f_s);
  if (h.kappa > kappa_old) h.z = softening(h.kappa);
  Branches const b = h.kappa > kappa_old ? branches(p, h.kappa, h.z, f_s) : old;
  if (h.kappa > kappa_old) { // the fall of stored energy at fixed separation
    Separation const mid = middle(now, before);
    double const sliding = length(mid);
    lost.mode_I += std::max(0.0, normal_energy(p, old, mid.opening) - normal_energy(p, b, mid.opening));
    lost.mode_II += std::max(0.0, shear_energy(p, old, sliding) - shear_energy(p, b, sliding));
  }
  Traction t = cohesive_part(p, b, now);
  if (has_friction(p, broken))
    add_friction(p, old, b, h, now, before, t, lost);
  else
    h.slip_1 = now.sliding_1, h.slip_2 = now.sliding_2;
  return t;
}

double cohesive_stored(CohesiveParams const& p, CohesiveHistory const& h, Separation now,
                       bool broken) noexcept {
  double const sliding = length(now);
  if (!p.crackable) return 0.5 * p.k * (now.opening * now.opening + sliding * sliding);
  double const kappa = broken ? 1 : h.kappa;
  double const z = broken ? 0 : kappa > 0 ? h.z : 1;
  Branches const b = branches(p, kappa, z, shear_strength(p, h, now.opening));
  double stored = normal_energy(p, b, now.opening) + shear_energy(p, b, sliding);
  if (kappa > 0 && has_friction(p, broken)) {
    double const e = length(now.sliding_1 - h.slip_1, now.sliding_2 - h.slip_2);
    stored += 0.5 * friction_stiffness(p, b) * e * e;
  }
  return stored;
}

CrackMode crack_mode(Dissipation const& total) noexcept {
  double const sum = total.mode_I + total.mode_II;
  if (!(sum > 0)) return CrackMode::none;
  double const share = total.mode_I / sum;
  return share >= 0.8 ? CrackMode::opening : share <= 0.2 ? CrackMode::sliding : CrackMode::mixed;
}

} // namespace fissura::laws
