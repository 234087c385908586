// A ripple on the strain of a bar, as an explicit run rings it, does not lose the branch the load has chosen:
// whatever the path, and by every steel law. Some hundred paths here, more with FISSURA_RANDOM.
#include "fissura/laws/steel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "fissura/laws/bar_joint.hpp"
#include "fissura/laws/cohesive.hpp"
#include "support/cohesive_input.hpp"
#include "support/random.hpp"

namespace {
using namespace fissura::laws;
using fissura::support::Random;
using fissura::support::random_count;

constexpr SteelLaw laws[] = {SteelLaw::kato, SteelLaw::menegotto_pinto};
constexpr double ripples[] = {5e-6, 2e-5, 1e-4};

SteelParams any_steel(Random& r, SteelLaw law) {
  SteelParams p;
  p.law = law;
  p.E_s = r.uniform(180e9, 220e9), p.f_y = r.log_uniform(300e6, 900e6), p.f_u = p.f_y * r.uniform(1.02, 1.6);
  p.eps_sh = p.eps_y() * r.uniform(1.5, 12), p.eps_u = p.eps_sh + r.uniform(0.03, 0.15);
  p.eps_br = p.eps_u * r.uniform(1.05, 1.5);
  return p;
}

std::vector<double> any_turns(Random& r, double from, double to) {
  std::vector<double> turns(8);
  double const reach = r.log_uniform(from, to);
  for (auto& turn : turns) turn = reach * r.uniform(-0.6, 1);
  return turns;
}

/// Calls f(smooth, ripple) along straight legs. The ripple fades in and out at their ends: both paths turn at
/// the same points.
void along(std::vector<double> const& turns, double ripple, double step, double period,
           std::function<void(double, double)> const& f) {
  double from = 0;
  for (double const to : turns) {
    int const n = std::max(1000, static_cast<int>(std::abs(to - from) / step));
    for (int i = 1; i <= n; ++i) {
      double const fade = std::min(1.0, std::min(i, n - i) / (2 * period));
      f(from + (to - from) * i / n, ripple * fade * std::sin(2 * 3.14159265358979 * i / period));
    }
    from = to;
  }
}

struct Findings {
  double off = 0;     ///< most by which a stress is off beyond what is allowed / that
  double created = 0; ///< deepest fall of work - sigma^2/(2 E_s) below zero / f_y^2/(2 E_s)
};

/// Allowed: ripple x E_s + 1 MPa where both strains are the same, and beside it what separates them just
/// then.
Findings ripple_along(SteelParams const& p, std::vector<double> const& turns, double ripple, double period) {
  SteelHistory plain, rippled;
  Findings f;
  double strain = 0, stress = 0, work = 0;
  along(turns, ripple, 4e-6, period, [&](double x, double d) {
    double const smooth = steel_stress(p, plain, x), s = steel_stress(p, rippled, x + d);
    if (plain.ruptured || rippled.ruptured) return;
    double const allowed = ripple * p.E_s + 1e6;
    f.off = std::max(f.off, (std::abs(s - smooth) - p.E_s * std::abs(d)) / allowed);
    work += 0.5 * (s + stress) * (x + d - strain);
    strain = x + d, stress = s;
    f.created = std::max(f.created, (steel_recoverable(p, s) - work) / steel_recoverable(p, p.f_y));
  });
  return f;
}

// Requirement: on any path the stress under a ripple is that of the smooth path, to ripple x E_s + 1 MPa, and
// no energy comes from the ripple.
TEST(InnerLoops, a_ripple_leaves_the_branch_of_a_steel_as_it_is) {
  for (auto const law : laws)
    for (double const ripple : ripples) {
      double worst = 0;
      for (int i = 0, n = random_count(40); i < n; ++i) {
        Random r(static_cast<unsigned>(i));
        auto const p = any_steel(r, law);
        auto const turns = any_turns(r, p.eps_y(), 0.05);
        auto const f = ripple_along(p, turns, ripple, r.uniform(30, 300));
        worst = std::max(worst, f.off);
        ASSERT_LE(f.off, 1) << int(law) << ", ripple " << ripple << ", path " << i;
        ASSERT_LE(f.created, 1e-4) << int(law) << ", ripple " << ripple << ", path " << i;
      }
      RecordProperty("law_" + std::to_string(int(law)) + "_ripple_" + std::to_string(ripple),
                     std::to_string(worst));
    }
}
} // namespace
