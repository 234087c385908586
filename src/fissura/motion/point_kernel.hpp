#pragma once
// One node is one pack of four: x, y, z and a lane without meaning. The copies of a point lie anywhere, so
// nodes side by side would have to be gathered; its axes need not.
#include "fissura/core/pack.hpp"
#include "fissura/motion/kernels.hpp"

#pragma GCC diagnostic ignored "-Wpsabi" // everything here is inlined: no call passes a pack

namespace fissura::motion {
inline namespace FISSURA_ISA {

using Axes = double __attribute__((vector_size(4 * sizeof(double))));

inline Axes axes(double const* p) {
  return Axes{p[0], p[1], p[2], 0};
}
inline Axes axes(Vec3 v) {
  return Axes{v.x, v.y, v.z, 0};
}
inline void put(double* p, Axes a) {
  p[0] = a[0], p[1] = a[1], p[2] = a[2];
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

inline void move(PointPass const& pass, std::size_t begin, std::size_t end, state::TetSums& sums) {
  Axes const g = axes(pass.gravity);
  double const kept = pass.scale * pass.keep, pushed = pass.scale * pass.dt, dt = pass.dt;
  Axes at_n{}, of_change{}, weighed{};
  for (std::size_t p = begin; p < end; ++p) {
    prefetch_point(pass, p, end);
    int const from = pass.first[p], to = pass.first[p + 1];
    Axes pull{};
    if (to - from > 1) {
      for (int c = from; c < to; ++c) {
        auto const& row = pass.row[c];
        pull += row.beta * (axes(pass.force + core::per_node * static_cast<std::size_t>(pass.leader[c])) +
                            row.weight * g);
      }
      pull *= pushed * pass.per_pull[p];
    }
    Axes mean{}, change{};
    for (int c = from; c < to; ++c) {
      auto const& row = pass.row[c];
      auto const at = core::per_node * static_cast<std::size_t>(pass.leader[c]);
      Axes const f = axes(pass.force + at) + row.weight * g, old = axes(pass.v + at);
      Axes const now = kept * old + (pushed * row.inverse) * f + row.beta * pull;
      put(pass.v + at, now);
      put(pass.u + at, axes(pass.u + at) + dt * now);
      double const inertia = row.mass + row.mu;
      Axes const twice = old + now, step = now - old;
      at_n += inertia * twice * twice, of_change += inertia * step * step;
      mean += row.mu * twice, change += row.mu * step;
      weighed += row.weight * now;
    }
    at_n -= pass.per_mu[p] * mean * mean, of_change -= pass.per_mu[p] * change * change;
  }
  sums.kinetic.at_n += 0.125 * sum(at_n), sums.kinetic.of_change += 0.125 * sum(of_change);
  sums.gravity += dt * sum(weighed * axes(pass.gravity_mean));
}

} // namespace FISSURA_ISA
} // namespace fissura::motion
