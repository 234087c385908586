// Curves of the material laws for the figures of the theory pages: name, branch, x, y as CSV, computed by the
// functions that the program steps with. tools/law_figures.py draws them.
#include <cmath>
#include <cstdio>
#include <initializer_list>

#include "fissura/laws/bond_slip.hpp"
#include "fissura/laws/cohesive.hpp"
#include "fissura/laws/dowel.hpp"
#include "fissura/laws/rate_factor.hpp"
#include "fissura/laws/softening.hpp"
#include "fissura/laws/steel_kato.hpp"
#include "fissura/laws/steel_menegotto_pinto.hpp"

namespace {
using namespace fissura::laws;

void row(char const* curve, char const* branch, double x, double y) {
  std::printf("%s,%s,%.9g,%.9g\n", curve, branch, x, y);
}

/// Calls f along a path of straight legs, `steps` to a leg.
template <class F> void along(std::initializer_list<double> turns, int steps, F f) {
  double from = *turns.begin();
  f(from);
  for (double const to : turns) {
    for (int i = 1; to != from && i <= steps; ++i) f(from + (to - from) * i / steps);
    from = to;
  }
}

void softening_curve() {
  along({0, 1}, 200, [](double d) { row("softening", "", d, softening(d)); });
}

/// Concrete of the examples: E 30 GPa, p = 20 E, h = 50 mm, f_t 3 MPa, G_f 100 J/m2, c 7 MPa, phi 36 degrees,
/// G_s 300 J/m2.
CohesiveInput concrete() {
  CohesiveInput in;
  in.p = 600e9, in.h = 0.05, in.f_t = 3e6, in.G_f = 100, in.G_s = 300, in.cohesion = 7e6,
  in.friction_angle = 0.6283;
  return in;
}

void tension_curve() {
  auto const p = make_cohesive_params(concrete());
  CohesiveHistory h;
  Separation before;
  along({0, 5e-6, -0.3e-6, 25e-6, -0.3e-6, 100e-6}, 400, [&](double o) {
    Dissipation lost;
    Separation const now{o, 0, 0};
    row("tension", "", 1e6 * o, cohesive_traction(p, h, now, before, h.kappa >= 1, lost).sigma / 1e6);
    before = now;
  });
}

void shear_curve(char const* branch, double pressure) {
  auto const p = make_cohesive_params(concrete());
  CohesiveHistory h;
  double const o = -pressure / p.k;
  Separation before{o, 0, 0};
  along({0, 40e-6, 25e-6, 140e-6}, 800, [&](double s) {
    Dissipation lost;
    Separation const now{o, s, 0};
    row("shear", branch, 1e6 * s, cohesive_traction(p, h, now, before, h.kappa >= 1, lost).tau_1 / 1e6);
    before = now;
  });
}

template <class Law, class History> void steel_curve(char const* curve) {
  Law const law{{200e9, 420e6, 550e6, 0.015, 0.1, 0.12, SteelLaw::kato}};
  History pulled, cycled;
  along({0, 0.12}, 1200, [&](double e) { row(curve, "pulled", 100 * e, law(pulled, e) / 1e6); });
  along({0, 0.02, 0, 0.03, -0.01, 0.05}, 800,
        [&](double e) { row(curve, "cycled", 100 * e, law(cycled, e) / 1e6); });
}

void bond_curve_of(char const* branch, double alpha) {
  SteelParams const steel{200e9, 420e6, 550e6, 0.015, 0.1, 0.12, SteelLaw::kato};
  auto const p = make_bond_params({0.016, 30e6, alpha}, steel);
  BondHistory h;
  h.sigma_cr = 40e6;
  along({0, 1.2e-3 * alpha, 0.8e-3 * alpha, 3e-3 * alpha}, 800,
        [&](double S) { row("bond", branch, 1e3 * S, 100 * bond_strain(p, h, S, 1)); });
}

void dowel_curve(char const* branch, double S) {
  auto const p = make_dowel_params({0.016, M_PI * 0.016 * 0.016 / 4, 200e9, 420e6, 30e6});
  DowelHistory h;
  along({0, 0.6e-3, 0.1e-3, 2e-3}, 400, [&](double t) {
    row("dowel", branch, 1e3 * t, dowel_force(p, h, S, t) / 1e3);
    row("dowel_strength", branch, 1e3 * t, h.strength);
  });
}

void rate_curve() {
  along({-7, 2.4}, 200,
        [](double x) { row("rate", "", std::pow(10, x), rate_factor_mc2010(std::pow(10, x))); });
}

} // namespace

int main() {
  std::printf("curve,branch,x,y\n");
  softening_curve();
  tension_curve();
  shear_curve("0", 0), shear_curve("5", 5e6), shear_curve("10", 10e6);
  steel_curve<SteelKato, KatoHistory>("kato");
  steel_curve<SteelMenegottoPinto, MenegottoPintoHistory>("menegotto_pinto");
  bond_curve_of("alone", 1), bond_curve_of("l_cr", slip_reduction(5));
  dowel_curve("0.1", 0.1e-3), dowel_curve("1", 1e-3);
  rate_curve();
}
