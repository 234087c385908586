#pragma once
// One node is one pack of four: x, y, z and a lane without meaning. The copies of a point lie anywhere, so
// nodes side by side would have to be gathered; its axes need not.
#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include "fissura/core/pack.hpp"
#include "fissura/motion/kernels.hpp"

#pragma GCC diagnostic ignored "-Wpsabi" // everything here is inlined: no call passes a pack

namespace fissura::motion {
inline namespace FISSURA_ISA {

using Axes = double __attribute__((vector_size(4 * sizeof(double))));

// Three numbers in one instruction where there is one: their packing would be a third of the pass.
inline Axes axes(double const* p) {
#if defined(__AVX512VL__)
  return (Axes)_mm256_maskz_loadu_pd(0b111, p);
#elif defined(__AVX2__)
  return (Axes)_mm256_maskload_pd(p, __m256i{-1, -1, -1, 0});
#else
  return Axes{p[0], p[1], p[2], 0};
#endif
}
inline Axes axes(Vec3 v) {
  return Axes{v.x, v.y, v.z, 0};
}
inline void put(double* p, Axes a) {
#if defined(__AVX512VL__)
  _mm256_mask_storeu_pd(p, 0b111, (__m256d)a);
#else
  p[0] = a[0], p[1] = a[1], p[2] = a[2];
#endif
}
inline double sum(Axes a) {
  return a[0] + a[1] + a[2];
}

/// Fetches the copies of the point after the next.
[[gnu::always_inline]] inline void prefetch_point(PointPass const& pass, std::size_t point, std::size_t end) {
  if (point + 2 >= end) return;
  for (int c = pass.first[point + 2]; c < pass.first[point + 3]; ++c) {
    auto const at = static_cast<std::size_t>(core::per_node * pass.leader[c]);
    __builtin_prefetch(pass.force + at);
    __builtin_prefetch(pass.u + at, core::to_write);
    __builtin_prefetch(pass.v + at, core::to_write);
  }
}

/// `heavy`: gravity acts. `read`: the whole of the kinetic energy is asked for.
template <bool heavy, bool read>
void move_points(PointPass const& pass, std::size_t begin, std::size_t end, state::TetSums& sums) {
  Axes const g = axes(pass.gravity);
  double const kept = pass.scale * pass.keep, pushed = pass.scale * pass.dt, dt = pass.dt;
  auto const force_on = [&](int c, std::size_t at) {
    Axes f = axes(pass.force + at);
    if constexpr (heavy) f += pass.weight[c] * g;
    return f;
  };
  Axes at_n{}, of_change{}, weighed{};
  for (std::size_t p = begin; p < end; ++p) {
    prefetch_point(pass, p, end);
    int const from = pass.first[p], to = pass.first[p + 1];
    Axes pull{};
    if (to - from > 1) {
      for (int c = from; c < to; ++c)
        pull += pass.row[c].beta * force_on(c, core::per_node * static_cast<std::size_t>(pass.leader[c]));
      pull *= pushed * pass.per_pull[p];
    }
    Axes mean{}, change{};
    for (int c = from; c < to; ++c) {
      auto const& row = pass.row[c];
      auto const at = core::per_node * static_cast<std::size_t>(pass.leader[c]);
      Axes const old = axes(pass.v + at);
      Axes const now = kept * old + (pushed * row.inverse) * force_on(c, at) + row.beta * pull;
      put(pass.v + at, now);
      put(pass.u + at, axes(pass.u + at) + dt * now);
      Axes const twice = old + now;
      at_n += row.inertia * twice * twice, mean += row.mu * twice;
      if constexpr (read) {
        Axes const step = now - old;
        of_change += row.inertia * step * step, change += row.mu * step;
      }
      if constexpr (heavy) weighed += pass.weight[c] * now;
    }
    at_n -= pass.per_mu[p] * mean * mean;
    if constexpr (read) of_change -= pass.per_mu[p] * change * change;
  }
  sums.kinetic.at_n += 0.125 * sum(at_n), sums.kinetic.of_change += 0.125 * sum(of_change);
  sums.gravity += dt * sum(weighed * axes(pass.gravity_mean));
}

inline void move(PointPass const& pass, std::size_t begin, std::size_t end, state::TetSums& sums) {
  bool const heavy = dot(pass.gravity, pass.gravity) > 0 || dot(pass.gravity_mean, pass.gravity_mean) > 0;
  auto const which = heavy ? (pass.reads_energy ? &move_points<true, true> : &move_points<true, false>)
                           : (pass.reads_energy ? &move_points<false, true> : &move_points<false, false>);
  which(pass, begin, end, sums);
}

} // namespace FISSURA_ISA
} // namespace fissura::motion
