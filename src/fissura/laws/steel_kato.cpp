#include "fissura/laws/steel_kato.hpp"

#include <algorithm>
#include <cmath>

namespace fissura::laws {

namespace {

/// strain > eps_y, without the division.
bool is_beyond_yield(SteelParams const& p, double strain) {
  return p.E_s * strain > p.f_y;
}

/// Slope parameter of curves (2) and (4) [Pa]: the further the bar has yielded, the rounder they are.
double bauschinger_modulus(SteelParams const& p, double eps_max) {
  double const beyond = std::max(eps_max - p.eps_y(), 1e-5);
  return std::clamp(-p.E_s / 6 * std::log10(10 * beyond), 0.02 * p.E_s, 0.6 * p.E_s);
}

/// f_y [a - a(a-1)/(E_B x/f_y + a - 1)]: leaves x = 0 with slope E_s and tends to a f_y.
double rounded(SteelParams const& p, double E_B, double x) {
  double const a = p.E_s / (p.E_s - E_B);
  return p.f_y * (a - a * (a - 1) / (E_B * x / p.f_y + a - 1));
}

/// The plateau also caps strains below eps_y, or curve (4) could pass f_y there and fall back with a jump.
double tensile_limit(SteelParams const& p, double strain) {
  return is_beyond_yield(p, strain) ? kato_envelope(p, strain) : p.f_y;
}

/// Branches of Kato's steel. Both directions: own_1 is E_B [Pa], frozen at the reversal. Rising: own_2 is the
/// stress of a compressive reversal over f_y, which may fall; E_B = 0: it began in tension, without curve
/// (4).
struct KatoBranches {
  SteelParams const& p;
  SteelHistory& h;

  double indifferent() const noexcept { return 1e-9 * p.f_y; }

  double stress_on(Branch const& b, int direction, double strain) const noexcept {
    double const elastic = b.stress + p.E_s * (strain - b.strain);
    return direction < 0 ? unloading(b, strain, elastic) : loading(b, strain, elastic);
  }

  Branch branch_from(double strain, double stress, int direction, BranchList&) const noexcept {
    Branch b;
    b.strain = strain, b.stress = stress;
    bool const yielded = is_beyond_yield(p, h.eps_largest);
    if (direction < 0 || (yielded && stress < 0)) b.own_1 = bauschinger_modulus(p, h.eps_largest);
    if (direction > 0) b.own_2 = stress / p.f_y;
    if (direction < 0 && yielded && stress >= 0) h.eps_z = std::max(h.eps_z, strain - stress / p.E_s);
    return b;
  }

 private:
  double unloading(Branch const& b, double strain, double elastic) const noexcept {
    // Without a zero crossing there is no curve (2): so it is too where shear has lowered f_y below the
    // stress of the largest strain only since the bar turned.
    bool const has_crossed = h.eps_z > SteelHistory{}.eps_z;
    if (!is_beyond_yield(p, h.eps_largest) || !has_crossed) return std::max(elastic, -p.f_y);
    if (elastic < 0 && strain < h.eps_z) return std::max(elastic, -rounded(p, b.own_1, h.eps_z - strain));
    return elastic;
  }

  double loading(Branch const& b, double strain, double elastic) const noexcept {
    double const stress = std::min(elastic, tensile_limit(p, strain));
    double const beyond = strain - (b.strain + p.eps_y()); // past the start of curve (4)
    if (b.own_1 == 0 || beyond <= 0) return stress;
    return std::min(stress, (b.own_2 + 1) * p.f_y + rounded(p, b.own_1, beyond));
  }
};

} // namespace

double kato_envelope(SteelParams const& p, double strain) noexcept {
  if (strain <= p.eps_y()) return p.E_s * strain;
  if (strain <= p.eps_sh) return p.f_y;
  if (strain <= p.eps_u) {
    double const x = (p.eps_u - strain) / (p.eps_u - p.eps_sh);
    return p.f_u - (p.f_u - p.f_y) * x * x;
  }
  if (strain >= p.eps_br) return 0;
  double const x = (strain - p.eps_u) / (p.eps_br - p.eps_u);
  return p.f_u * (1 - x * x);
}

double SteelKato::operator()(KatoHistory& h, double strain) const noexcept {
  auto const& p = params;
  if (h.ruptured) {
    h.strain = strain;
    return 0;
  }
  KatoBranches branches{p, h};
  follow(branches, h, strain);
  if (is_beyond_yield(p, strain)) h.eps_largest = std::max(h.eps_largest, strain);
  if (strain >= p.eps_br) h.ruptured = true, h.stress = 0;
  return h.stress;
}

void SteelKato::weaken(KatoHistory& h) const noexcept {
  if (h.ruptured || h.direction == 0) return;
  auto const& p = params;
  if (is_beyond_yield(p, h.strain)) h.eps_largest = std::max(h.eps_largest, h.strain);
  KatoBranches const branches{p, h};
  // In compression the bound is the branch the bar is on, or has left.
  bool const has_left = h.direction > 0 && !h.falling.empty();
  double const limit = h.stress > 0      ? tensile_limit(p, h.strain)
                       : h.direction < 0 ? branches.stress_on(h.now, -1, h.strain)
                       : has_left        ? branches.stress_on(h.falling.innermost(), -1, h.strain)
                                         : h.stress;
  laws::weaken(branches, h, limit);
}

} // namespace fissura::laws
