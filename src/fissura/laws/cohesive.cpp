#include "fissura/laws/cohesive.hpp"

#include <cmath>
#include <string>

#include "fissura/core/error.hpp"
#include "fissura/laws/cohesive_law.hpp"

namespace fissura::laws {

namespace {

LawPack<double> pack_of(CohesiveParams const& p) {
  auto const one_if = [](bool b) { return b ? 1.0 : 0.0; };
  return {p.k,
          1 / p.k,
          p.f_t,
          p.o_p,
          p.o_r,
          1 / p.o_r,
          p.f_s,
          p.tan_phi,
          p.friction,
          p.shear_work,
          1 / p.shear_work,
          one_if(p.mohr_coulomb),
          one_if(p.straight_tension),
          one_if(p.straight_shear),
          one_if(p.law == CohesiveLaw::paper)};
}
HistoryPack<double> pack_of(CohesiveHistory const& h) {
  return {h.kappa, h.z, h.f_s, h.slid_1, h.slid_2};
}
SeparationPack<double> pack_of(Separation const& s) {
  return {s.opening, s.sliding_1, s.sliding_2};
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
  out.o_r = range * in.G_f / in.f_t;
  out.G_f = in.G_f;
  out.G_s = in.G_s > 0 ? in.G_s : in.G_f;
  out.mohr_coulomb = in.mohr_coulomb;
  out.f_s = in.mohr_coulomb ? in.cohesion : in.f_s;
  out.tan_phi = in.mohr_coulomb ? std::tan(in.friction_angle) : 0;
  out.shear_work = range * out.G_s;
  return with_stiffness(out, out.k);
}

CohesiveParams with_stiffness(CohesiveParams p, double k) noexcept {
  p.k = k;
  if (p.crackable) p.o_p = (p.straight_tension ? 1 : 2) * p.f_t / k;
  return p;
}

CohesiveParams with_strength(CohesiveParams p, double factor) noexcept {
  p.f_t *= factor;
  p.f_s *= factor;
  p.o_p *= factor;
  p.o_r /= factor;
  return p;
}

double cohesive_damage(CohesiveParams const& p, CohesiveHistory const& h, Separation now) noexcept {
  if (!p.crackable) return 0;
  auto const law = pack_of(p);
  return damage_at(law, shear_strength(law, pack_of(h), now.opening), now.opening,
                   square_sliding(pack_of(now)));
}

Traction cohesive_traction(CohesiveParams const& p, CohesiveHistory& h, Separation now, Separation before,
                           bool broken, Dissipation& lost) noexcept {
  if (!p.crackable) return {p.k * now.opening, p.k * now.sliding_1, p.k * now.sliding_2};
  auto history = pack_of(h);
  DissipationPack<double> sum{lost.mode_I, lost.mode_II, lost.friction};
  auto const t = cohesive_law(pack_of(p), history, pack_of(now), pack_of(before), broken ? 1.0 : 0.0, sum);
  h = {history.kappa, history.z, history.f_s, history.slid_1, history.slid_2};
  lost = {sum.mode_I, sum.mode_II, sum.friction};
  return {t.sigma, t.tau_1, t.tau_2};
}

double cohesive_stored(CohesiveParams const& p, CohesiveHistory const& h, Separation now,
                       bool broken) noexcept {
  if (!p.crackable) {
    double const sliding = sliding_of(pack_of(now));
    return 0.5 * p.k * (now.opening * now.opening + sliding * sliding);
  }
  return stored_energy(pack_of(p), pack_of(h), pack_of(now), broken ? 1.0 : 0.0);
}

CrackMode crack_mode(Dissipation const& total) noexcept {
  double const sum = total.mode_I + total.mode_II;
  if (!(sum > 0)) return CrackMode::none;
  double const share = total.mode_I / sum;
  return share >= 0.8 ? CrackMode::opening : share <= 0.2 ? CrackMode::sliding : CrackMode::mixed;
}

} // namespace fissura::laws
