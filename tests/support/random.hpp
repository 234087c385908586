#pragma once
// Random numbers for tests, and how many random cases a property test runs.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "fissura/core/vec3.hpp"

namespace fissura::support {

/// A small random number generator whose numbers are the same with every standard library (splitmix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// Uniform in [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53);
  }
  /// The logarithm is uniform; low > 0.
  double log_uniform(double low, double high) { return low * std::exp(uniform(0, std::log(high / low))); }
  bool chance(double share) { return uniform(0, 1) < share; }
  int below(int n) { return static_cast<int>(uniform(0, n)); }
  Vec3 vector(double low, double high) {
    double const x = uniform(low, high), y = uniform(low, high), z = uniform(low, high);
    return {x, y, z};
  }

 private:
  std::uint64_t state;
};

/// `few` cases in ctest, or as many as the environment variable FISSURA_RANDOM asks for (`make properties`).
inline int random_count(int few) {
  char const* const wanted = std::getenv("FISSURA_RANDOM");
  int const n = wanted ? std::atoi(wanted) : 0;
  return n > 0 ? n : few;
}

} // namespace fissura::support
