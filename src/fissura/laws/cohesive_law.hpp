#pragma once
// The cohesive law of laws/cohesive.hpp for one point (V = double) or a pack of points. One source for both:
// where points differ in what they do, both ways are computed and each lane keeps its own.
#include "fissura/core/pack.hpp"
#include "fissura/laws/softening.hpp"

namespace fissura::laws {
inline namespace FISSURA_ISA {

using core::choose;

template <class V> struct SeparationPack { V opening, sliding_1, sliding_2; };
template <class V> struct TractionPack { V sigma, tau_1, tau_2; };
template <class V> struct DissipationPack { V mode_I, mode_II, friction; };
/// As CohesiveHistory.
template <class V> struct HistoryPack { V kappa, z, f_s, slid_1, slid_2; };
/// As CohesiveParams of joints that can crack; what is true or false there is 1 or 0 here. Divisions are
/// dear: reciprocals are kept beside the values.
template <class V> struct LawPack {
  V k, per_k, f_t, o_p, o_r, per_o_r, f_s, tan_phi, friction, shear_work, per_shear_work;
  V mohr_coulomb, straight_tension, straight_shear, paper;
};

/// Damage over which the parabola of Eq. 13 turns into a straight secant (energy_consistent).
inline constexpr double straightening = 0.05;

template <class V> inline V length(V a, V b) {
  return core::square_root(V(a * a + b * b));
}
template <class V> inline V square_sliding(SeparationPack<V> const& s) {
  return s.sliding_1 * s.sliding_1 + s.sliding_2 * s.sliding_2;
}
template <class V> inline V sliding_of(SeparationPack<V> const& s) {
  return core::square_root(square_sliding(s));
}

/// The shape of both branches at a given damage and shear strength: all that depends on the history.
template <class V> struct Branches {
  V kappa;
  V z;                 ///< share of strength left
  V f_s;               ///< [Pa]
  V s_p;               ///< sliding at the shear strength [m]
  V o_m, per_o_m;      ///< largest opening the damage stands for [m]; its reciprocal
  V per_s_m;           ///< reciprocal of the largest sliding [1/m]
  V w_normal, w_shear; ///< 0 parabola ... 1 straight line
};

template <class V> inline V shear_strength(LawPack<V> const& p, HistoryPack<V> const& h, V opening) {
  V const zero(0.0);
  V const now = choose(opening < zero, V(p.f_s - p.k * opening * p.tan_phi), p.f_s);
  return choose(h.f_s <= zero, now, h.f_s); // so that a NaN is not lost
}

/// Sliding at the strength: the parabola of Eq. 13 carried over to shear, or a straight line where the
/// strength depends on the pressure or the strain rate (a parabola would not be conservative).
template <class V> inline V peak_sliding(LawPack<V> const& p, V f_s) {
  return (V(2.0) - p.straight_shear) * f_s * p.per_k;
}

/// Softening range of the sliding [m].
template <class V> inline V sliding_range(LawPack<V> const& p, V f_s) {
  return p.shear_work / f_s;
}

/// Damage D, Eqs. 16, 18 and 19; square_sliding is that of the length of the sliding.
template <class V> inline V damage_at(LawPack<V> const& p, V f_s, V opening, V square_sliding) {
  V const zero(0.0);
  V const dt = core::larger(V((opening - p.o_p) * p.per_o_r), zero);
  V const s_p = peak_sliding(p, f_s);
  auto const slides = square_sliding > s_p * s_p;
  if (!core::any(slides)) return dt;
  V const excess = core::square_root(square_sliding) - s_p;
  return choose(slides, length(dt, V(excess * f_s * p.per_shear_work)), dt);
}

template <class V> inline Branches<V> branches(LawPack<V> const& p, V kappa, V z, V f_s) {
  Branches<V> b;
  b.kappa = kappa;
  b.z = z;
  b.f_s = f_s;
  b.s_p = peak_sliding(p, f_s);
  b.o_m = p.o_p + kappa * p.o_r;
  b.per_o_m = V(1.0) / b.o_m;
  b.per_s_m = f_s / (b.s_p * f_s + kappa * p.shear_work);
  V const zero(0.0), one(1.0), w = core::smaller(V(kappa * V(1 / straightening)), one);
  b.w_normal = choose(p.straight_tension > zero, one, w);
  b.w_shear = choose(p.straight_shear > zero, one, w);
  return b;
}

// ---- energy_consistent: psi = z f m Phi(x), x = separation/m -------------------------------------------

/// G(x)/x
template <class V> inline V secant_shape(V w, V x) {
  V const one(1.0);
  return (one + one - w) - (one - w) * x;
}
/// its integral
template <class V> inline V energy_shape(V w, V x) {
  V const one(1.0);
  return (V(0.5) * (one + one - w) - V(1.0 / 3) * (one - w) * x) * x * x;
}

// ---- paper: Eq. 13 below the peak, lowered in proportion to the secant from the largest separation
// -------------------

template <class V> inline V virgin_shape(V straight, V x) {
  V const zero(0.0), one(1.0);
  return choose(x >= one, one, choose(straight > zero, x, V((one + one - x) * x)));
}
template <class V> inline V virgin_energy(V straight, V x) {
  return choose(straight > V(0.0), V(V(0.5) * x * x), V((V(1.0) - V(1.0 / 3) * x) * x * x));
}

/// Work of unloading along the secant to the origin, with the other separation held at zero.
template <class V> inline V secant_energy(V strength, V peak, V largest, V straight, V separation) {
  V const below = core::smaller(separation, peak);
  V const beyond = choose(separation > peak, V(V(0.5) * (separation * separation - peak * peak)), V(0.0));
  return strength / largest * (peak * peak * virgin_energy(straight, V(below / peak)) + beyond);
}

// ---- both ----------------------------------------------------------------------------------------------

template <class V> inline V normal_energy(LawPack<V> const& p, Branches<V> const& b, V opening) {
  V const zero(0.0);
  V open = b.z * p.f_t * b.o_m * energy_shape(b.w_normal, V(opening * b.per_o_m));
  if (auto const paper = p.paper > zero; core::any(paper))
    open = choose(paper, secant_energy(V(b.z * p.f_t), p.o_p, b.o_m, p.straight_tension, opening), open);
  return choose(opening < zero, V(V(0.5) * p.k * opening * opening), open);
}

template <class V> inline V shear_energy(LawPack<V> const& p, Branches<V> const& b, V sliding) {
  V const s_m = b.s_p + b.kappa * sliding_range(p, b.f_s);
  V stored = b.z * b.f_s * s_m * energy_shape(b.w_shear, V(sliding * b.per_s_m));
  if (auto const paper = p.paper > V(0.0); core::any(paper))
    stored = choose(paper, secant_energy(V(b.z * b.f_s), b.s_p, s_m, p.straight_shear, sliding), stored);
  return stored;
}

/// `most`: the damage up to which the secant of `paper` runs on; that of the branches unless they are of the
/// step before.
template <class V>
inline TractionPack<V> cohesive_part(LawPack<V> const& p, Branches<V> const& b, SeparationPack<V> const& at,
                                     V most) {
  V const zero(0.0), one(1.0), x = at.opening * b.per_o_m, square = square_sliding(at);
  V open = b.z * p.f_t * secant_shape(b.w_normal, x) * x;
  V slope = b.z * b.f_s * b.per_s_m; // tau over sliding, of a straight branch
  if (core::any(b.w_shear < one))
    slope = slope * secant_shape(b.w_shear, V(core::square_root(square) * b.per_s_m));
  if (auto const paper = p.paper > zero; core::any(paper)) {
    V const sliding = core::square_root(square);
    V const d = core::smaller(most, damage_at(p, b.f_s, at.opening, square));
    open = choose(paper,
                  V(b.z * p.f_t * virgin_shape(p.straight_tension, V(at.opening / p.o_p)) *
                    ((p.o_p + d * p.o_r) / b.o_m)),
                  open);
    V const tau = b.z * b.f_s * virgin_shape(p.straight_shear, V(sliding / b.s_p)) *
                  ((b.s_p + d * sliding_range(p, b.f_s)) * b.per_s_m);
    slope = choose(paper, choose(sliding > zero, V(tau / sliding), zero), slope);
  }
  V const sigma = choose(at.opening < zero, V(p.k * at.opening), open);
  return {sigma, slope * at.sliding_1, slope * at.sliding_2};
}

/// Before any damage, Eqs. 13 and 17.
template <class V>
inline TractionPack<V> undamaged_traction(LawPack<V> const& p, SeparationPack<V> const& at) {
  V const zero(0.0), one(1.0), o = at.opening, linear = p.k * o;
  auto const is_straight = o < zero || p.straight_tension > zero;
  V const sigma = choose(is_straight, linear, V(linear * (one - V(0.5) * o / p.o_p)));
  V const bent = p.k * (one - V(0.25) * p.k * sliding_of(at) / p.f_s);
  V const slope = choose(p.straight_shear > zero, p.k, bent);
  return {sigma, slope * at.sliding_1, slope * at.sliding_2};
}

/// Stiffness of the friction spring [Pa/m]: what the cohesive secant leaves of k, so that both together never
/// exceed the k that the stable step knows. k itself once cohesion is gone.
template <class V> inline V friction_stiffness(LawPack<V> const& p, Branches<V> const& b) {
  return p.k * (V(1.0) - b.z * b.s_p * b.per_s_m);
}

/// Coulomb friction with a spring in parallel to the cohesive part; |t| <= (1 - z) mu |sigma|. Adds to `t`
/// where `has_friction`; elsewhere the slip follows the faces. `has_grown`: the branches differ somewhere.
template <class V, class M>
inline void add_friction(LawPack<V> const& p, Branches<V> const& old, Branches<V> const& b, bool has_grown,
                         M has_friction, HistoryPack<V>& h, SeparationPack<V> const& now,
                         SeparationPack<V> const& before, TractionPack<V>& t, V& lost) {
  V const zero(0.0), half(0.5), one(1.0);
  V const k_old = friction_stiffness(p, old), k = has_grown ? friction_stiffness(p, b) : k_old;
  auto const acts = has_friction && k > zero;
  V const e_1 = before.sliding_1 - h.slid_1, e_2 = before.sliding_2 - h.slid_2;
  V const t0_1 = k_old * e_1, t0_2 = k_old * e_2;
  V loss = zero, from_1 = h.slid_1, from_2 = h.slid_2;
  // The spring has stiffened with damage: keep its force, not its stretch, or energy would appear.
  if (auto const stiffens = k > k_old; has_grown && core::any(stiffens)) {
    V const keep = choose(stiffens, V(k_old / k), one);
    loss = half * (one - keep) * (t0_1 * e_1 + t0_2 * e_2);
    from_1 = choose(stiffens, V(before.sliding_1 - keep * e_1), from_1);
    from_2 = choose(stiffens, V(before.sliding_2 - keep * e_2), from_2);
  }

  V t_1 = k * (now.sliding_1 - from_1), t_2 = k * (now.sliding_2 - from_2);
  V const limit = choose(t.sigma < zero, V((b.z - one) * p.friction * t.sigma), zero);
  V slid_1 = from_1, slid_2 = from_2;
  auto const slides = t_1 * t_1 + t_2 * t_2 > limit * limit;
  if (core::any(slides)) {
    V const share = limit * core::inverse_root(V(t_1 * t_1 + t_2 * t_2));
    slid_1 = choose(slides, V(now.sliding_1 - share * (now.sliding_1 - from_1)), from_1);
    slid_2 = choose(slides, V(now.sliding_2 - share * (now.sliding_2 - from_2)), from_2);
    t_1 = choose(slides, V(share * t_1), t_1), t_2 = choose(slides, V(share * t_2), t_2);
    // Mean traction times slip: exact for the trapezoidal work of the step. Where a step turns the force
    // right round while the pressure falls, the mean may oppose the slip; friction never gives energy back.
    V const work = half * ((t0_1 + t_1) * (slid_1 - from_1) + (t0_2 + t_2) * (slid_2 - from_2));
    loss = loss + choose(slides, core::larger(work, zero), zero);
  }

  lost = lost + choose(acts, loss, zero);
  h.slid_1 = choose(acts, slid_1, now.sliding_1);
  h.slid_2 = choose(acts, slid_2, now.sliding_2);
  t.tau_1 = t.tau_1 + choose(acts, t_1, zero);
  t.tau_2 = t.tau_2 + choose(acts, t_2, zero);
}

/// What the step has lost because the branches have fallen from `old` to `b` [J/m2], `t` the tractions of `b`
/// at `now`. The step's work is the trapezoid of the tractions before and now. On the old branches alone it
/// would be recoverable; so lost is the fall of the stored energy at `now`, less the share that the falling
/// traction has not worked. (On a straight branch: half the fall of stiffness times both separations.) The
/// fall in the middle of the step would book more than was put in where joints fail within a few steps.
template <class V>
inline DissipationPack<V> damage_loss(LawPack<V> const& p, Branches<V> const& old, Branches<V> const& b,
                                      SeparationPack<V> const& now, SeparationPack<V> const& before,
                                      TractionPack<V> const& t) {
  V const half(0.5), sliding = sliding_of(now);
  auto const on_old = cohesive_part(p, old, now, b.kappa);
  V const work_I = (on_old.sigma - t.sigma) * (now.opening - before.opening);
  V const work_II = (on_old.tau_1 - t.tau_1) * (now.sliding_1 - before.sliding_1) +
                    (on_old.tau_2 - t.tau_2) * (now.sliding_2 - before.sliding_2);
  return {normal_energy(p, old, now.opening) - normal_energy(p, b, now.opening) - half * work_I,
          shear_energy(p, old, sliding) - shear_energy(p, b, sliding) - half * work_II, V(0.0)};
}

/// See laws/cohesive.hpp. `broken` is 1 for a crack-face pair, else 0.
template <class V>
inline TractionPack<V> cohesive_law(LawPack<V> const& p, HistoryPack<V>& h, SeparationPack<V> const& now,
                                    SeparationPack<V> const& before, V broken, DissipationPack<V>& lost) {
  V const zero(0.0), one(1.0);
  V const f_s = shear_strength(p, h, now.opening);
  V const kappa_old = h.kappa, z_old = choose(kappa_old > zero, h.z, one);
  V const reached = core::smaller(one, damage_at(p, f_s, now.opening, square_sliding(now)));
  V const kappa = core::larger(kappa_old, choose(broken > zero, one, reached));
  auto const is_damaged = kappa > zero;
  auto const grows = kappa > kappa_old;

  HistoryPack<V> next = h;
  next.kappa = kappa;
  next.z = z_old;
  Branches<V> const old = branches(p, kappa_old, z_old, f_s);
  Branches<V> b = old;
  bool const has_grown = core::any(grows);
  if (has_grown) {
    auto const is_new = is_damaged && kappa_old <= zero;
    next.f_s = choose(is_new && p.mohr_coulomb > zero, f_s, h.f_s);
    next.slid_1 = choose(is_new, before.sliding_1, h.slid_1); // friction starts without a jump
    next.slid_2 = choose(is_new, before.sliding_2, h.slid_2);
    next.z = choose(grows, softening(kappa), z_old);
    b = branches(p, kappa, next.z, f_s);
  }
  TractionPack<V> t = cohesive_part(p, b, now, kappa);
  if (has_grown) {
    auto const fall = damage_loss(p, old, b, now, before, t);
    lost.mode_I = lost.mode_I + choose(grows, core::larger(fall.mode_I, zero), zero);
    lost.mode_II = lost.mode_II + choose(grows, core::larger(fall.mode_II, zero), zero);
  }
  auto const has_friction = broken > zero || p.mohr_coulomb > zero;
  V friction(0.0);
  add_friction(p, old, b, has_grown, has_friction, next, now, before, t, friction);
  lost.friction = lost.friction + choose(is_damaged, friction, zero);

  h.kappa = next.kappa;
  h.z = choose(is_damaged, next.z, h.z);
  h.f_s = next.f_s;
  h.slid_1 = choose(is_damaged, next.slid_1, h.slid_1);
  h.slid_2 = choose(is_damaged, next.slid_2, h.slid_2);
  if (auto const is_fresh = kappa <= zero; core::any(is_fresh)) {
    TractionPack<V> const fresh = undamaged_traction(p, now);
    t = {choose(is_fresh, fresh.sigma, t.sigma), choose(is_fresh, fresh.tau_1, t.tau_1),
         choose(is_fresh, fresh.tau_2, t.tau_2)};
  }
  return t;
}

/// Recoverable energy [J/m2], see cohesive_stored.
template <class V>
inline V stored_energy(LawPack<V> const& p, HistoryPack<V> const& h, SeparationPack<V> const& now, V broken) {
  V const zero(0.0), half(0.5), one(1.0);
  V const kappa = choose(broken > zero, one, h.kappa);
  V const z = choose(broken > zero, zero, choose(kappa > zero, h.z, one));
  Branches<V> const b = branches(p, kappa, z, shear_strength(p, h, now.opening));
  V const cohesive = normal_energy(p, b, now.opening) + shear_energy(p, b, sliding_of(now));
  V const e_1 = now.sliding_1 - h.slid_1, e_2 = now.sliding_2 - h.slid_2;
  auto const rubs = kappa > zero && (broken > zero || p.mohr_coulomb > zero);
  return cohesive + choose(rubs, V(half * friction_stiffness(p, b) * (e_1 * e_1 + e_2 * e_2)), zero);
}

} // namespace FISSURA_ISA
} // namespace fissura::laws
