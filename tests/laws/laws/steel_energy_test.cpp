// Cyclic steel: no path creates energy, no branch is stiffer than E_s.
#include "fissura/laws/steel.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace {
using namespace fissura::laws;

struct Findings {
  double slope = 0;      ///< steepest slope / E_s
  double dip = 0;        ///< deepest fall of work - sigma^2/(2 E_s) below an earlier value [J/m3]
  double dissipated = 0; ///< at the end [J/m3]
  double least = 0;      ///< smallest work - stored [J/m3]
};

Findings wander(SteelParams const& p, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-0.02, 0.07);
  SteelHistory h;
  Findings f;
  double strain = 0, stress = 0, work = 0, most = 0;
  for (int leg = 0; leg < 40; ++leg) {
    double const from = strain, to = u(random);
    for (int i = 1; i <= 4000; ++i) {
      double const next = from + (to - from) * i / 4000, s = steel_stress(p, h, next);
      f.slope = std::max(f.slope, std::abs((s - stress) / (next - strain)) / p.E_s);
      work += 0.5 * (s + stress) * (next - strain);
      strain = next, stress = s;
      f.dissipated = work - steel_recoverable(p, stress);
      f.least = std::min(f.least, f.dissipated);
      most = std::max(most, f.dissipated);
      f.dip = std::max(f.dip, most - f.dissipated);
    }
  }
  return f;
}

// On random histories the dissipated energy is never negative and the slope never exceeds E_s, by either law.
// After a reversal in compression the bar can give back more than sigma^2/(2 E_s) (Bauschinger effect), so
// dissipation is not monotonic: hardly with Kato's law, by up to a quarter of f_u^2/(2 E_s) with the smooth
// curves.
TEST(SteelEnergy, RandomHistories) {
  for (auto law : {SteelLaw::kato, SteelLaw::menegotto_pinto})
    for (SteelParams p : {SteelParams{210e9, 530e6, 650e6, 0.03, 0.1, 0.12, law},
                          SteelParams{190e9, 350e6, 540e6, 0.0165, 0.1, 0.12, law}}) {
      double dip = 0;
      for (unsigned seed = 0; seed < 10; ++seed) {
        auto const f = wander(p, seed);
        EXPECT_LE(f.slope, 1 + 1e-4) << int(law) << " " << seed;
        EXPECT_GE(f.least, -1e-3) << int(law) << " " << seed;
        EXPECT_GT(f.dissipated, 2e8);
        dip = std::max(dip, f.dip);
      }
      RecordProperty((law == SteelLaw::kato ? "kato_" : "mp_") + std::to_string(int(p.E_s / 1e9)),
                     std::to_string(dip / steel_recoverable(p, p.f_u)));
      EXPECT_LT(dip, (law == SteelLaw::kato ? 1e-3 : 0.3) * steel_recoverable(p, p.f_u)) << p.E_s;
    }
}
} // namespace
