#include "fissura/laws/steel_menegotto_pinto.hpp"

#include <algorithm>
#include <cmath>

namespace fissura::laws {

namespace {

constexpr double R_0 = 20, a_1 = 18.5, a_2 = 0.15, a_3 = 0.01, a_4 = 7;

/// Below this share of eps_y the virgin curve is taken as straight (it differs by 5e-8): no power is needed
/// there.
constexpr double straight_until = 0.5;

double hardening(SteelParams const& p) {
  return (p.f_u - p.f_y) / (p.eps_u - p.eps_y()) / p.E_s;
}

/// Plastic strain over eps_y up to which a bar counts as elastic.
constexpr double elastic_until = 0.05;

/// Plastic strain of a loop, over eps_y, below which the new branch grows sharper: without any it is a
/// straight line to the branch that it resumes, which a round one would miss a little each time.
constexpr double closes_until = 0.25, straight = 0;

/// Plastic strain of a loop, over eps_y, from which on it hardens the bar isotropically, and where it does so
/// in full. Without a threshold the ripples of an explicit run would add up to it.
constexpr double hardens_from = 0.25, hardens_fully = 1;

/// x/(1 + |x|^R)^(1/R). A branch of a small loop is sharp (R of some hundreds): far along it, |x|^R
/// overflows.
double rounded_corner(double x, double R) {
  double const far = std::abs(x);
  return far <= 1 ? x / std::pow(1 + std::pow(far, R), 1 / R)
                  : std::copysign(1 / std::pow(1 + std::pow(far, -R), 1 / R), x);
}

/// Branches of Menegotto-Pinto steel: own_1 is the roundness R (or `straight`), own_2 the isotropic shift of
/// the yield asymptote as a share of f_y.
struct MenegottoPintoBranches {
  SteelParams const& p;
  SteelHistory& h;
  double b = hardening(p);

  double indifferent() const noexcept { return 1e-9 * p.f_y; }

  double stress_on(Branch const& c, int direction, double strain) const noexcept {
    return std::clamp(curve(c, direction, strain), -p.f_u, p.f_u);
  }

  /// `resumed` are the branches of the new direction that are remembered. What they still promise sets the
  /// roundness of the new one; how much has yielded since sets how much of the isotropic hardening counts.
  Branch branch_from(double strain, double stress, int direction, BranchList& resumed) const noexcept {
    Branch c;
    c.strain = strain, c.stress = stress;
    double const extreme = std::max(h.eps_largest, -h.eps_smallest);
    c.own_2 = std::max(0.0, a_3 * (extreme / p.eps_y() - a_4));
    double target = direction > 0 ? std::max(h.eps_largest, p.eps_y()) : std::min(h.eps_smallest, -p.eps_y());
    if (!resumed.empty()) {
      Branch& old = resumed.innermost();
      target = old.left;
      double const plastic =
          direction * ((old.left - strain) - (stress_on(old, direction, old.left) - stress) / p.E_s);
      double const share =
          std::clamp((plastic / p.eps_y() - hardens_from) / (hardens_fully - hardens_from), 0.0, 1.0);
      c.own_2 = old.own_2 + share * std::max(0.0, c.own_2 - old.own_2);
      for (int i = 0; i < resumed.count; ++i) {
        auto& shift = resumed.at[static_cast<std::size_t>(i)].own_2;
        shift = std::max(shift, c.own_2);
      }
    }
    double const span = strain_to_corner(c, direction);
    double const xi = std::max(0.0, direction * (target - strain - span)) / p.eps_y();
    c.own_1 = R_0 - a_1 * xi / (a_2 + xi);
    if (!resumed.empty()) {
      double const loop = xi / closes_until;
      if (loop < 1) c.own_1 = loop > 0.05 ? c.own_1 / loop : straight;
      return c;
    }
    // A bar that has not yielded has the corner of the virgin curve ahead, as sharp, wherever it turns.
    c.own_1 += R_0 * std::max(0.0, direction * span / p.eps_y() - 1) * std::max(0.0, 1 - xi / elastic_until);
    return c;
  }

 private:
  /// Strain from the reversal to the corner where the elastic line meets the yield asymptote.
  double strain_to_corner(Branch const& c, int direction) const noexcept {
    double const yield = direction * p.f_y * (1 - b) * (1 + c.own_2) + b * p.E_s * c.strain;
    return (yield - c.stress) / (p.E_s * (1 - b));
  }

  double curve(Branch const& c, int direction, double strain) const noexcept {
    double const span = strain_to_corner(c, direction), from = strain - c.strain;
    if (c.own_1 == straight) return c.stress + p.E_s * from;
    if (span * direction <= 1e-9 * p.eps_y()) return c.stress + b * p.E_s * from; // already on the asymptote
    double const x = from / span;
    double const round = rounded_corner(x, c.own_1);
    return c.stress + p.E_s * span * (b * x + (1 - b) * round);
  }
};

} // namespace

double SteelMenegottoPinto::operator()(MenegottoPintoHistory& h, double strain) const noexcept {
  auto const& p = params;
  if (h.ruptured) {
    h.strain = strain;
    return 0;
  }
  bool const virgin = h.direction == 0 && std::abs(strain) <= straight_until * p.eps_y();
  if (virgin) {
    h.stress = p.E_s * strain;
  } else {
    if (h.direction == 0) h.now.own_1 = R_0;
    MenegottoPintoBranches branches{p, h};
    follow(branches, h, strain);
  }
  h.strain = strain;
  h.eps_largest = std::max(h.eps_largest, strain);
  h.eps_smallest = std::min(h.eps_smallest, strain);
  if (strain >= p.eps_br) h.ruptured = true, h.stress = 0;
  return h.stress;
}

void SteelMenegottoPinto::weaken(MenegottoPintoHistory& h) const noexcept {
  if (h.ruptured || h.direction == 0) return;
  laws::weaken(MenegottoPintoBranches{params, h}, h, h.stress > 0 ? params.f_u : -params.f_u);
}

} // namespace fissura::laws
