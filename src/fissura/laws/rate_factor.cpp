#include "fissura/laws/rate_factor.hpp"

#include <algorithm>
#include <cmath>

namespace fissura::laws {

double rate_factor_mc2010(double rate) noexcept {
  constexpr double static_rate = 1e-6, kink = 10; // [1/s]
  double const slow = std::pow(std::clamp(rate, static_rate, kink) / static_rate, 0.018);
  return rate > kink ? std::max(slow, 0.0062 * std::cbrt(rate / static_rate)) : slow;
}

} // namespace fissura::laws
