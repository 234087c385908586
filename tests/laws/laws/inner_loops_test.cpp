// A ripple on the strain of a bar, as an explicit run rings it, does not lose the branch the load has chosen:
// whatever the path, and by every steel law. A hundred paths here, more with FISSURA_RANDOM.
#include "fissura/laws/steel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

/// Calls f(smooth, ripple) along straight legs. The ripple is cut off at their ends: both paths turn at the
/// same points, for a path that turns elsewhere is another path.
template <class F>
void along(std::vector<double> const& turns, double ripple, double step, double period, F f) {
  double from = 0;
  long total = 0;
  for (double const to : turns) {
    int const n = std::max(1000, static_cast<int>(std::abs(to - from) / step));
    for (int i = 1; i <= n; ++i) {
      double const x = from + (to - from) * i / n;
      double const with = x + ripple * std::sin(2 * 3.14159265358979 * static_cast<double>(++total) / period);
      f(x, i == n ? 0 : std::clamp(with, std::min(from, to), std::max(from, to)) - x);
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
  along(turns, ripple, 1e-5, period, [&](double x, double d) {
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
      for (int i = 0, n = random_count(100); i < n; ++i) {
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

// Requirement: a loop within a loop closes: a bar that is unloaded in compression by a fifth of its yield
// strain and pulled on has the stress it had, and goes on where the smooth path goes.
TEST(InnerLoops, passing_a_reversal_resumes_the_old_branch) {
  for (auto const law : laws) {
    SteelParams const p{200e9, 500e6, 600e6, 0.015, 0.1, 0.12, law};
    SteelHistory smooth, looped;
    auto go = [&](SteelHistory& h, std::vector<double> const& turns) {
      double stress = 0;
      for (double const to : turns)
        for (int i = 1, n = 2000; i <= n; ++i)
          stress = steel_stress(p, h, h.strain + (to - h.strain) / (n + 1 - i));
      return stress;
    };
    for (double const at : {0.02, -0.02, -0.016, 0.0, 0.015}) {
      double const expected = go(smooth, {at}), before = go(looped, {at});
      double const back = at - 0.2 * p.eps_y() * looped.direction;
      EXPECT_NEAR(before, expected, 1e3) << int(law) << " at " << at;
      EXPECT_NEAR(go(looped, {back, at, back, at}), expected, 1e3) << int(law) << " at " << at;
    }
  }
}

// Requirement: a bar that loses strength while it unloads falls to what is left and unloads from there: by
// E_s, and pulled on it yields at the strength it has now, not at the stress it had before.
TEST(InnerLoops, a_bar_weakened_while_it_unloads_unloads_from_what_is_left) {
  for (auto const law : laws) {
    SteelParams const p{200e9, 500e6, 600e6, 0.015, 0.1, 0.12, law};
    double const eps_y = p.eps_y(), left = 0.5, limit = left * (law == SteelLaw::kato ? p.f_y : p.f_u);
    SteelHistory h;
    auto go = [&](double to, double strength) {
      double stress = 0;
      for (int i = 1, n = 1000; i <= n; ++i)
        stress = steel_stress(p, h, h.strain + (to - h.strain) / (n + 1 - i), strength);
      return stress;
    };
    go(0.8 * eps_y, 1), go(0.75 * eps_y, 1);
    weaken_steel(p, h, left);
    EXPECT_NEAR(h.stress, limit, 1e3) << int(law);
    EXPECT_NEAR(go(0.65 * eps_y, left), limit - 0.1 * p.f_y, 1e-3 * p.f_y) << int(law);
    EXPECT_NEAR(go(0.7499 * eps_y, left), left * p.f_y, 0.01 * p.f_y) << int(law);
    EXPECT_LE(go(3 * eps_y, left), left * p.f_u) << int(law);
  }
}

// Requirement: a bar goes on as it would have after a small loop, however far it is pulled: the branch of
// such a loop is sharp, and its curve of a large power.
TEST(InnerLoops, a_bar_pulled_far_beyond_a_small_loop_is_on_its_curve) {
  for (auto const law : laws) {
    SteelParams const p{200e9, 500e6, 600e6, 0.015, 0.1, 0.12, law};
    for (double back = 0.5; back < 2; back += 0.02) {
      SteelHistory smooth, looped;
      for (double const to : {2.0, 2 - back, 2.02, 1.96, 40.0})
        for (int i = 1, n = 500; i <= n; ++i)
          steel_stress(p, looped, looped.strain + (to * p.eps_y() - looped.strain) / (n + 1 - i));
      for (int i = 1; i <= 2000; ++i) steel_stress(p, smooth, 40 * p.eps_y() * i / 2000);
      EXPECT_NEAR(looped.stress, smooth.stress, 0.01 * p.f_y) << int(law) << " by " << back;
    }
  }
}

// Requirement: a list of branches that is full gives up the one that makes the least difference: a ripple
// that dies away over a hundred cycles, each inside the last, leaves the bar on its branch.
TEST(InnerLoops, a_ripple_that_dies_away_leaves_the_branch_as_it_is) {
  for (auto const law : laws) {
    SteelParams const p{200e9, 500e6, 600e6, 0.015, 0.1, 0.12, law};
    SteelHistory smooth, rung;
    auto both = [&](double x, double d) {
      return std::abs(steel_stress(p, smooth, x) - steel_stress(p, rung, x + d));
    };
    auto go = [&](double to) {
      double const from = smooth.strain;
      double worst = 0;
      for (int i = 1; i <= 2000; ++i) worst = std::max(worst, both(from + (to - from) * i / 2000, 0));
      return worst;
    };
    for (double const at : {0.02, -0.02, -0.012}) EXPECT_LE(go(at), 1e3);
    double const way = 1e-4;
    for (int i = 0; i <= 10000; ++i)
      both(-0.012, way * std::exp(-i / 2000.0) * (std::cos(0.0628 * i) - 1) / 2);
    EXPECT_LE(go(-0.012 + 1e-9), way * p.E_s + 1e6) << int(law);
    EXPECT_LE(go(0.03), way * p.E_s + 1e6) << int(law);
  }
}

BarJointParams any_joint(Random& r, SteelLaw law) {
  BarJointInput in;
  in.D = r.log_uniform(6e-3, 0.04), in.A_s = 0.785 * in.D * in.D, in.f_c = r.log_uniform(20e6, 80e6);
  in.l_cr = in.D * r.log_uniform(1, 15), in.dowel = false;
  in.steel = any_steel(r, law);
  return make_bar_joint_params(in);
}

// Requirement: the same for the slip of a bar out of a crack: its own memory, the largest slip, is enough for
// the bond, and the steel behind it remembers its branches. A ripple of slip counts as the ripple of strain
// it makes before yield, when bond is stiffest; where the strain runs ahead of the slip (after yield) it is
// larger by k_e/H_1.
TEST(InnerLoops, a_ripple_of_slip_leaves_a_bar_joint_on_its_branch) {
  for (auto const law : laws)
    for (int i = 0, n = random_count(40); i < n; ++i) {
      Random r(static_cast<unsigned>(i));
      auto const p = any_joint(r, law);
      double const per_strain = p.bond.k_e / p.bond.normalise, S_y = per_strain * p.steel.eps_y();
      BarJointHistory smooth, rippled;
      for (auto* h : {&smooth, &rippled}) activate(p, *h, 0, {}, 0.1 * p.steel.f_y, 0);
      std::vector<double> turns(8);
      double const reach = S_y * r.log_uniform(1, 20);
      for (auto& turn : turns) turn = reach * r.uniform(-0.2, 1);
      double const ripple = 2e-5, ahead = std::max(1.0, p.bond.k_e / bond_curve(p.bond, 1, 0).H2);
      BarJointDissipation lost_smooth, lost;
      double worst = 0;
      along(turns, ripple * per_strain, 0.01 * S_y, r.uniform(30, 300), [&](double S, double d) {
        double const a = bar_joint_force(p, smooth, S, 0, lost_smooth).sigma;
        double const b = bar_joint_force(p, rippled, S + d, 0, lost).sigma;
        double const allowed = (ripple + std::abs(d) / per_strain) * ahead * p.steel.E_s + 1e6;
        if (!smooth.ruptured && !rippled.ruptured) worst = std::max(worst, std::abs(a - b) / allowed);
      });
      ASSERT_LE(worst, 1) << int(law) << ", path " << i;
    }
}

// Requirement: the cohesive law keeps one number of its past, the largest damage: whatever small loops a
// crack makes, its traction is the one without them.
TEST(InnerLoops, a_crack_forgets_the_loops_of_its_opening) {
  auto const p = make_cohesive_params(fissura::support::cohesive_input(false));
  CohesiveHistory smooth, looped;
  Dissipation lost;
  auto at = [&](CohesiveHistory& h, double o) {
    return cohesive_traction(p, h, {o, 0, 0}, {o, 0, 0}, h.kappa >= 1, lost).sigma;
  };
  for (int i = 1; i <= 500; ++i) {
    double const o = 1.5 * p.o_p + (i / 600.0) * p.o_r;
    at(looped, o);
    for (double const share : {0.99, 0.999, 0.5, 0.9}) at(looped, o - (1 - share) * p.o_p);
    EXPECT_EQ(at(looped, o), at(smooth, o)) << i;
    EXPECT_EQ(looped.kappa, smooth.kappa);
  }
}
} // namespace
