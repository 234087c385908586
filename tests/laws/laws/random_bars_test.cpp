// Properties of steel, bond, dowel and bar joints on any path with any parameters that make sense, and of the
// growth of strength with the strain rate. Some hundred paths here, 10^5 each in `make properties`
// (FISSURA_RANDOM).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "fissura/laws/bar_joint.hpp"
#include "fissura/laws/bar_joint_uncracked.hpp"
#include "fissura/laws/rate_factor.hpp"
#include "support/random.hpp"

namespace {
using namespace fissura::laws;
using fissura::support::Random;
using fissura::support::random_count;

SteelParams any_steel(Random& r, SteelLaw law) {
  SteelParams p;
  p.law = law;
  p.E_s = r.uniform(180e9, 220e9), p.f_y = r.log_uniform(200e6, 900e6), p.f_u = p.f_y * r.uniform(1.02, 1.6);
  p.eps_sh = p.eps_y() * r.uniform(1.5, 12), p.eps_u = p.eps_sh + r.uniform(0.03, 0.15);
  p.eps_br = p.eps_u * r.uniform(1.05, 1.5);
  return p;
}

// ---- steel ---------------------------------------------------------------------------------------------

struct SteelFindings {
  double slope = 0;      ///< steepest slope / E_s
  double least = 0;      ///< smallest work less what unloading gives back [J/m3]
  double highest = 0;    ///< stress [Pa]
  double lowest = 0;     ///< stress [Pa]
  double afterwards = 0; ///< largest stress once ruptured [Pa]
};

SteelFindings drive_steel(SteelParams const& p, Random& r) {
  SteelFindings f;
  SteelHistory h;
  double strain = 0, stress = 0, work = 0;
  double const reach = r.chance(0.2) ? 1.2 * p.eps_br : r.log_uniform(p.eps_y(), p.eps_u);
  for (int leg = 0; leg < 12; ++leg) {
    double const from = strain, to = r.uniform(-0.4, 1) * reach;
    for (int i = 1; i <= 400; ++i) {
      bool const was_ruptured = is_ruptured(p, h);
      double const next = from + (to - from) * i / 400, s = steel_stress(p, h, next);
      if (was_ruptured) f.afterwards = std::max(f.afterwards, std::abs(s));
      if (!is_ruptured(p, h)) f.slope = std::max(f.slope, std::abs((s - stress) / (next - strain)) / p.E_s);
      f.highest = std::max(f.highest, s), f.lowest = std::min(f.lowest, s);
      work += 0.5 * (s + stress) * (next - strain);
      strain = next, stress = s;
      f.least = std::min(f.least, work - steel_recoverable(p, stress));
    }
  }
  return f;
}

/// The descending branch of Fig. 10 ends with slope 2 f_u/(eps_br - eps_u), which may exceed E_s.
double steepest(SteelParams const& p) {
  return std::max(1.0, 2 * p.f_u / (p.eps_br - p.eps_u) / p.E_s);
}

/// Curve (2) of Kato's law tends to a f_y with a = E_s/(E_s - E_B) of at most 2.5, whatever f_u is.
double strongest_in_compression(SteelParams const& p) {
  return p.law == SteelLaw::kato ? std::max(2.5 * p.f_y, p.f_u) : p.f_u;
}

// Requirement: steel follows its strain without a jump and never more steeply than E_s (or than its own
// descent to rupture), stays within its tensile strength, gives back less than it took, and carries nothing
// once it is broken.
TEST(RandomPaths, steel) {
  for (auto const law : {SteelLaw::kato, SteelLaw::menegotto_pinto})
    for (int i = 0, n = random_count(500); i < n; ++i) {
      Random r(static_cast<unsigned>(i));
      auto const p = any_steel(r, law);
      auto const f = drive_steel(p, r);
      ASSERT_LE(f.slope, steepest(p) * (1 + 1e-3)) << int(law) << " path " << i;
      ASSERT_LE(f.highest, p.f_u * (1 + 1e-9)) << int(law) << " path " << i;
      ASSERT_GE(f.lowest, -strongest_in_compression(p) * (1 + 1e-9)) << int(law) << " path " << i;
      ASSERT_GE(f.least, -1e-4 * steel_recoverable(p, p.f_y)) << int(law) << " path " << i;
      ASSERT_EQ(f.afterwards, 0) << int(law) << " path " << i;
    }
}

// ---- bar joints ----------------------------------------------------------------------------------------

BarJointParams any_joint(Random& r, SteelLaw law, bool dowel) {
  BarJointInput in;
  in.D = r.log_uniform(5e-3, 0.05), in.A_s = 0.785 * in.D * in.D * r.uniform(1, 4);
  in.f_c = r.log_uniform(10e6, 120e6), in.l_cr = in.D * r.log_uniform(0.5, 30), in.dowel = dowel;
  in.steel = any_steel(r, law);
  return make_bar_joint_params(in);
}

/// One with the consistent reduction, whose closed cracks follow a line of their own.
BarJointParams any_consistent_joint(Random& r, SteelLaw law, bool dowel) {
  BarJointInput in;
  in.D = r.log_uniform(5e-3, 0.05), in.A_s = 0.785 * in.D * in.D * r.uniform(1, 4);
  in.f_c = r.log_uniform(10e6, 120e6), in.dowel = dowel;
  in.l_g = in.D * r.log_uniform(0.3, 30), in.l_b = in.D * r.log_uniform(0.5, 30);
  in.steel = any_steel(r, law);
  return make_bar_joint_params(in);
}

/// A bar joint on its way: all that the next step depends on.
struct BarPoint {
  BarJointHistory h{};
  double S = 0, t = 0;
  BarJointForce force{};
  bool touching = false;

  BarJointForce go(BarJointParams const& p, double S_next, double t_next, BarJointDissipation& lost) {
    S = S_next, t = t_next;
    return force = bar_joint_force(p, h, S_next, t_next, lost, touching);
  }
};
/// A step that is to be taken again in small pieces.
struct BarStep {
  double jump = 0; ///< change of the stress [Pa]
  BarPoint from{};
  double S = 0, t = 0;
};

/// Takes a step again in ever smaller pieces, each time the one with the largest jump: what is continuous
/// loses it.
double jump_left(BarJointParams const& p, BarStep step) {
  for (int level = 0; level < 6; ++level) {
    BarPoint x = step.from;
    BarStep largest;
    for (int i = 1; i <= 32; ++i) {
      BarPoint const was = x;
      BarJointDissipation lost;
      x.go(p, step.from.S + (step.S - step.from.S) * i / 32, step.from.t + (step.t - step.from.t) * i / 32,
           lost);
      double const jump = std::abs(x.force.sigma - was.force.sigma);
      if (!x.h.ruptured && jump >= largest.jump) largest = {jump, was, x.S, x.t};
    }
    step = largest;
  }
  return step.jump;
}

struct BarFindings {
  double imbalance = 0; ///< largest |work - change of stored - lost| / work
  double dip = 0;       ///< deepest fall of what was lost / (work + energy at yield)
  double created = 0;   ///< largest energy that came out beyond all that was put in / the same
  double jump = 0;      ///< of the stress / f_y
  std::string trouble{};
};

/// Drives a bar joint along eight legs of slip and offset and holds it to its bounds.
struct BarDriver {
  BarJointParams p;
  BarPoint x{};
  double stored_0 = 0, net = 0, work = 0, most = 0, dip = 0, least = 0, imbalance = 0;
  BarJointDissipation lost{};
  BarStep largest{}, at_yield{};
  std::string trouble{};

  void expect(bool ok, char const* what) {
    if (!ok && trouble.empty()) trouble = what;
  }
  void open_crack(Random& r) {
    double const sigma_cr = r.uniform(-0.05, 0.3) * p.steel.f_y;
    stored_0 = r.uniform(0, 1);
    activate(p, x.h, 0, {}, sigma_cr, stored_0);
    expect(std::abs(x.h.sigma - sigma_cr) <= 1e-9 * p.steel.f_y, "the stress jumps when the crack opens");
    x.force.sigma = x.h.sigma;
  }
  void step(double S, double t) {
    BarPoint const was = x;
    x.go(p, S, t, lost);
    double const axial = p.A_s * (was.force.sigma + x.force.sigma) * (S - was.S),
                 across = (was.force.V_s + x.force.V_s) * (t - was.t);
    net += axial + across, work += std::abs(axial) + std::abs(across);
    double const total = lost.bond_steel + lost.dowel;
    most = std::max(most, total), dip = std::max(dip, most - total), least = std::min(least, total);
    imbalance = std::max(imbalance, std::abs(net + stored_0 - bar_joint_stored(p, x.h) - total));
    double const jump = std::abs(x.force.sigma - was.force.sigma);
    if (!x.h.ruptured && jump > largest.jump) largest = {jump, was, S, t};
    if (!was.h.yielded && x.h.yielded) at_yield = {jump, was, S, t};
    check(was.h, t);
  }
  void check(BarJointHistory const& was, double t) {
    auto const& h = x.h;
    double const sigma = x.force.sigma, V_s = x.force.V_s;
    expect(sigma <= p.steel.f_u * (1 + 1e-9) && sigma >= -strongest_in_compression(p.steel) * (1 + 1e-9),
           "the bar is stressed beyond its strength");
    expect(V_s >= 0 && V_s <= p.dowel.stiffness * t * (1 + 1e-9), "the dowel pulls, or grows stiffer");
    expect(h.dowel.DI >= was.dowel.DI && h.dowel.softening <= was.dowel.softening, "the dowel recovers");
    expect(h.dowel.strength <= was.dowel.strength && h.dowel.strength >= 0, "shear gives strength back");
    expect(!was.activated || h.activated, "a bar joint is not activated any more");
    expect(!was.yielded || h.yielded, "a bar joint has not yielded any more");
    expect(!was.ruptured || (h.ruptured && sigma == 0 && V_s == 0), "a broken bar carries");
    expect(!was.bond.yielded || h.bond.s_max >= was.bond.s_max, "the largest slip falls");
    expect(std::isfinite(h.strain) && std::isfinite(sigma), "a number is not finite");
  }
};

/// `closes`: the faces of the crack touch on some of the legs, from and to a step at random.
BarFindings drive_joint(BarJointParams const& p, Random& r, bool closes = false) {
  BarDriver d{p};
  d.open_crack(r);
  double const at_yield = p.energy_factor * p.bond.k_e * p.steel.f_y * p.steel.f_y;
  double const S_y = p.bond.k_e * p.steel.eps_y() / p.bond.normalise, reach = S_y * r.log_uniform(0.3, 60);
  double const offset = p.with_dowel ? p.D * r.log_uniform(1e-4, 0.3) : 0;
  for (int leg = 0; leg < 8; ++leg) {
    double const S = d.x.S, t = d.x.t, S_to = r.uniform(-0.1, 1) * reach, t_to = r.uniform(0, 1) * offset;
    int const first = closes && r.chance(0.7) ? 1 + static_cast<int>(r.uniform(0, 500)) : 501,
              last = closes ? first + static_cast<int>(r.uniform(0, 700)) : 0;
    for (int i = 1; i <= 500; ++i) {
      d.x.touching = i >= first && i < last;
      d.step(S + (S_to - S) * i / 500, t + (t_to - t) * i / 500);
    }
  }
  BarFindings f;
  f.trouble = d.trouble;
  f.imbalance = d.imbalance / (d.work + at_yield + d.stored_0), f.dip = d.dip / (d.work + at_yield);
  f.created = -d.least / (d.work + at_yield);
  f.jump = std::max(jump_left(p, d.largest), jump_left(p, d.at_yield)) / p.steel.f_y;
  return f;
}

/// The worst of random bar joints, without and with dowel; `closes`: with the consistent reduction, in cracks
/// that close and open.
BarFindings worst_joint(SteelLaw law, bool closes = false) {
  BarFindings worst;
  for (bool const dowel : {false, true})
    for (int i = 0, n = random_count(300); i < n; ++i) {
      Random r(static_cast<unsigned>(i));
      auto const p = closes ? any_consistent_joint(r, law, dowel) : any_joint(r, law, dowel);
      auto const f = drive_joint(p, r, closes);
      if (!f.trouble.empty() && worst.trouble.empty())
        worst.trouble = f.trouble + ", path " + std::to_string(i) + (dowel ? " with dowel" : "");
      worst.imbalance = std::max(worst.imbalance, f.imbalance), worst.dip = std::max(worst.dip, f.dip);
      worst.created = std::max(worst.created, f.created), worst.jump = std::max(worst.jump, f.jump);
    }
  testing::Test::RecordProperty("dip", std::to_string(worst.dip));
  testing::Test::RecordProperty("created", std::to_string(worst.created));
  testing::Test::RecordProperty("jump", std::to_string(worst.jump));
  return worst;
}

// Requirement: on any path of slip and offset the accounts of a bar joint close, no more comes out than was
// put in, its stress stays within the strength of the steel and does not jump, damage of the dowel, yielding
// and rupture are for good. Of what was lost some may come back just past yield, where the strain runs ahead
// of the slip (known: laws/bar_joint_energy_test.cpp): less than 3 % of the work with 2e5 random steels,
// bonds and paths.
TEST(RandomPaths, bar_joints) {
  auto const worst = worst_joint(SteelLaw::kato);
  EXPECT_EQ(worst.trouble, "");
  EXPECT_LT(worst.imbalance, 1e-9);
  EXPECT_LT(worst.created, 1e-12);
  EXPECT_LT(worst.dip, 0.03);
  EXPECT_LT(worst.jump, 1e-4);
}

// Requirement: the same with Menegotto-Pinto's steel, which gives back more than its elastic unloading
// promises (Bauschinger effect): with 2e5 random ones up to 6.1 % of the work out of what was lost (without
// dowel, just after yield, where the unloading line of the slip is flattest), and up to 0.08 % beyond all
// that was put in, just past its round yield point.
TEST(RandomPaths, bar_joints_of_menegotto_pinto) {
  auto const worst = worst_joint(SteelLaw::menegotto_pinto);
  EXPECT_EQ(worst.trouble, "");
  EXPECT_LT(worst.imbalance, 1e-9);
  EXPECT_LT(worst.created, 2e-3);
  EXPECT_LT(worst.dip, 0.065);
  EXPECT_LT(worst.jump, 1e-4);
}

// Requirement: the same in cracks that close and open at any time. What comes out beyond all that was put in
// is, without dowel, the trapezoid over the kink where a crack closes (1e-7), and with dowel up to 0.09 %
// where shear weakens a closed bar below its stress at cracking (2e5 random ones).
TEST(RandomPaths, bar_joints_in_closing_cracks) {
  auto const worst = worst_joint(SteelLaw::kato, true);
  EXPECT_EQ(worst.trouble, "");
  EXPECT_LT(worst.imbalance, 1e-9);
  EXPECT_LT(worst.created, 1e-3);
  EXPECT_LT(worst.dip, 0.03);
  EXPECT_LT(worst.jump, 1e-4);
}
// Requirement: the same with Menegotto-Pinto's steel: up to 0.58 % (2e5 random ones).
TEST(RandomPaths, bar_joints_of_menegotto_pinto_in_closing_cracks) {
  auto const worst = worst_joint(SteelLaw::menegotto_pinto, true);
  EXPECT_EQ(worst.trouble, "");
  EXPECT_LT(worst.imbalance, 1e-9);
  EXPECT_LT(worst.created, 7e-3);
  EXPECT_LT(worst.dip, 0.065);
  EXPECT_LT(worst.jump, 1e-4);
}

// Requirement: the paths of 10^5 that once broke the bounds above keep them in every run of the tests: two
// branches that cross (71554, 84520), shear that weakens a bar which unloads in tension (49987, 37894,
// 50692), in compression (15055; in closing cracks 24587, 68734, 87922) or inside a loop (30599, 44183), a
// sharp branch followed far (83880).
TEST(RandomPaths, that_once_failed) {
  auto const kato = SteelLaw::kato, menegotto_pinto = SteelLaw::menegotto_pinto;
  for (auto const& [law, path] : {std::pair{kato, 71554u}, {menegotto_pinto, 84520u}}) {
    Random r(path);
    auto const p = any_steel(r, law);
    EXPECT_LE(drive_steel(p, r).slope, steepest(p) * (1 + 1e-3)) << path;
  }
  struct Failed {
    SteelLaw law;
    bool dowel;
    unsigned path;
    double created, dip;
  };
  for (auto const& [law, dowel, path, created, dip] :
       {Failed{kato, true, 49987, 1e-12, 1e-3}, Failed{kato, true, 37894, 1e-12, 1e-9},
        Failed{kato, true, 50692, 1e-12, 1e-9}, Failed{kato, true, 15055, 1e-12, 1e-9},
        Failed{menegotto_pinto, true, 30599, 1e-12, 1e-9}, Failed{menegotto_pinto, true, 44183, 1e-12, 1e-3},
        Failed{menegotto_pinto, false, 83880, 1e-12, 0.065}}) {
    Random r(path);
    auto const f = drive_joint(any_joint(r, law, dowel), r);
    EXPECT_EQ(f.trouble, "") << path;
    EXPECT_LT(f.created, created) << path;
    EXPECT_LT(f.dip, dip) << path;
    EXPECT_LT(f.jump, 1e-4) << path;
  }
  for (unsigned const path : {24587u, 68734u, 87922u}) {
    Random r(path);
    auto const f = drive_joint(any_consistent_joint(r, kato, true), r, true);
    EXPECT_EQ(f.trouble, "") << path;
    EXPECT_LT(f.jump, 1e-4) << path;
  }
}

// Requirement: before cracking the stress of a bar joint is the slope of its stored energy, which is never
// negative, and its stiffness stays below the bound that the stable step counts with.
TEST(RandomPaths, uncracked_bar_joints) {
  for (int i = 0, n = random_count(500); i < n; ++i) {
    Random r(static_cast<unsigned>(i));
    double const A_s = r.log_uniform(1e-5, 2e-3);
    auto const u = uncracked_bar_joint(r.uniform(3, 12), r.log_uniform(1e11, 1e13), r.log_uniform(1e-3, 0.3),
                                       r.log_uniform(1e6, 8e6), A_s, r.chance(0.8));
    double const scale = std::isfinite(u.d_peak) ? u.d_peak : 1e-6;
    for (int k = 0; k < 50; ++k) {
      double const d = r.uniform(-3, 3) * scale, step = 1e-4 * scale;
      double const force = (u.stored(d + step) - u.stored(d - step)) / (2 * step);
      ASSERT_NEAR(force, A_s * u.stress(d), 1e-3 * A_s * u.slope * scale) << "path " << i;
      ASSERT_GE(u.stored(d), 0);
      ASSERT_LE(std::abs(A_s * (u.stress(d + step) - u.stress(d))), u.stiffness_bound() * step * (1 + 1e-9));
    }
  }
}

// ---- dowel ---------------------------------------------------------------------------------------------

// Requirement: a dowel that is taken round any path of offset and slip and back to no offset has taken work,
// not given it: the length of its bent zone only grows.
TEST(RandomPaths, dowels) {
  for (int i = 0, n = random_count(500); i < n; ++i) {
    Random r(static_cast<unsigned>(i));
    DowelInput in;
    in.D = r.log_uniform(5e-3, 0.05), in.A_s = 0.785 * in.D * in.D, in.E_s = 2e11,
    in.f_y = r.log_uniform(2e8, 9e8), in.f_c = r.log_uniform(1e7, 1.2e8);
    auto const p = make_dowel_params(in);
    DowelHistory h;
    double t = 0, S = 0, V = 0, work = 0, absolute = 0;
    double const reach = in.D * r.log_uniform(1e-3, 1);
    for (int leg = 0; leg < 12; ++leg) {
      double const t_to = leg % 3 == 2 ? 0 : r.uniform(0, 1) * reach, S_to = r.uniform(-0.2, 1) * in.D,
                   t_from = t, S_from = S;
      for (int k = 1; k <= 300; ++k) {
        double const next = t_from + (t_to - t_from) * k / 300;
        S = S_from + (S_to - S_from) * k / 300;
        double const now = dowel_force(p, h, S, next), w = (V + now) * (next - t);
        work += w, absolute += std::abs(w);
        t = next, V = now;
        // The trapezoid misses the bend of the curve: second order in the step.
        ASSERT_GE(work - dowel_stored(p, h, t), -1e-3 * absolute) << "path " << i << " leg " << leg;
      }
    }
  }
}

// ---- strain rate ---------------------------------------------------------------------------------------

// Requirement: the strength never falls with the rate, is never below the static one, and has no jump.
TEST(RandomPaths, rate_factor) {
  Random r(1);
  for (int i = 0, n = random_count(2000); i < n; ++i) {
    double const slow = r.log_uniform(1e-9, 1e4), fast = slow * (1 + r.log_uniform(1e-9, 10));
    double const a = rate_factor_mc2010(slow), b = rate_factor_mc2010(fast);
    ASSERT_GE(a, 1);
    ASSERT_LE(a, b) << slow << " " << fast;
    ASSERT_LE(b, a * std::cbrt(fast / slow) * (1 + 1e-9)) << slow << " " << fast; // its steepest power is 1/3
  }
}

} // namespace
