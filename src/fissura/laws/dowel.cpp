#include "fissura/laws/dowel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fissura/core/error.hpp"

namespace fissura::laws {

DowelParams make_dowel_params(DowelInput const& in) {
  auto require = [](bool ok, char const* what) {
    if (!ok) throw core::Error(core::Failure::input, std::string("dowel: ") + what);
  };
  require(in.D > 0, "the bar diameter D must be positive");
  require(in.A_s > 0, "the steel area A_s must be positive");
  require(in.E_s > 0, "Young's modulus E_s must be positive");
  require(in.f_y > 0, "the yield stress f_y must be positive");
  require(in.f_c > 0, "the compressive strength f_c must be positive");
  double const pi = std::numbers::pi;
  double const E = in.E_s / 1e6, D = 1e3 * in.D, f_c = in.f_c / 1e6; // N, mm, MPa
  double const I = pi * D * D * D * D / 64;
  double const L_c0 = 0.75 * pi * std::pow(4 * E * I / (150 * std::pow(f_c, 0.85)), 0.25);
  double const bars = in.A_s / (0.25 * pi * in.D * in.D);
  DowelParams p;
  p.D = in.D, p.A_s = in.A_s, p.f_y = in.f_y;
  p.L_c0 = 1e-3 * L_c0;
  p.stiffness = 1e3 * bars * 384.0 / 11 * E * I / (L_c0 * L_c0 * L_c0);
  return p;
}

double dowel_force(DowelParams const& p, DowelHistory& h, double S, double t_s) noexcept {
  double const DI = (1 + 150 * std::max(S, 0.0) / p.D) * t_s / p.D;
  if (DI > h.DI) {
    h.DI = DI;
    if (DI > 0.02) {
      double const longer = 1 + 3 * std::pow(DI - 0.02, 0.8);
      h.softening = 1 / (longer * longer * longer);
    }
  }
  double const V = p.stiffness * h.softening * t_s;
  if (V > h.V_max) {
    h.V_max = V;
    double const shear = V / (p.A_s * p.f_y);
    h.strength = std::sqrt(std::max(0.0, 1 - 3 * shear * shear));
  }
  return V;
}

} // namespace fissura::laws
