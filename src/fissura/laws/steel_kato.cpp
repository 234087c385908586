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

void turn(SteelParams const& p, KatoHistory& h, int direction) {
  bool const yielded = is_beyond_yield(p, h.eps_max);
  if (h.direction != 0) h.eps_v = h.strain, h.sigma_v = h.stress;
  if (yielded && direction > 0 && h.stress < 0) {
    h.eps_pm = h.strain, h.share_pm = h.stress / p.f_y;
    h.E_B_loading = bauschinger_modulus(p, h.eps_max);
  }
  if (yielded && direction < 0 && h.stress >= 0) {
    h.E_B_unloading = bauschinger_modulus(p, h.eps_max);
    h.eps_z = std::max(h.eps_z, h.eps_v - h.sigma_v / p.E_s);
  }
  h.direction = direction;
}

/// The plateau also caps strains below eps_y, or curve (4) could pass f_y there and fall back with a jump.
double tensile_limit(SteelParams const& p, double strain) {
  return is_beyond_yield(p, strain) ? kato_envelope(p, strain) : p.f_y;
}

double unloading(SteelParams const& p, KatoHistory const& h, double strain, double elastic) {
  // Where shear has lowered the strength since the bar turned, what the elastic line promises is too much.
  double const line = std::min(elastic, tensile_limit(p, strain));
  // Without a zero crossing there is no curve (2): so it is too where shear has lowered f_y below the stress
  // of eps_max only since the bar turned.
  bool const has_crossed = h.eps_z > KatoHistory{}.eps_z;
  if (!is_beyond_yield(p, h.eps_max) || !has_crossed) return std::max(line, -p.f_y);
  if (elastic < 0 && strain < h.eps_z)
    return std::max(elastic, -rounded(p, h.E_B_unloading, h.eps_z - strain));
  return line;
}

double loading(SteelParams const& p, KatoHistory const& h, double strain, double elastic) {
  double stress = std::min(elastic, tensile_limit(p, strain));
  if (strain > h.eps_pm) {
    double const beyond = strain - (h.eps_pm + p.eps_y()), sigma_k = (h.share_pm + 1) * p.f_y;
    if (beyond > 0) stress = std::min(stress, sigma_k + rounded(p, h.E_B_loading, beyond));
  }
  return stress;
}

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
  if (strain != h.strain) {
    int const direction = strain > h.strain ? 1 : -1;
    if (direction != h.direction) turn(p, h, direction);
  }
  double const elastic = h.sigma_v + p.E_s * (strain - h.eps_v);
  h.stress = h.direction < 0 ? unloading(p, h, strain, elastic) : loading(p, h, strain, elastic);
  h.strain = strain;
  if (is_beyond_yield(p, strain)) h.eps_max = std::max(h.eps_max, strain);
  if (strain >= p.eps_br) h.ruptured = true, h.stress = 0;
  return h.stress;
}

} // namespace fissura::laws
