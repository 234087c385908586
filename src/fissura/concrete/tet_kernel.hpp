#pragma once
// Tet forces (Eqs. 6-12), the gather of the joint forces, and the integration of Eq. (1) in one pass over the
// tets. Included only by the files that are compiled per instruction set.
#include <algorithm>

#include "fissura/concrete/kernels.hpp"
#include "fissura/core/pack.hpp"

namespace fissura::concrete {
inline namespace FISSURA_ISA {

using core::load;
using core::Vec;

template <class V> struct Mat {
  Vec<V> x, y, z; // rows
};
/// sum over the three edges of (edge vector) x (reference gradient).
template <class V> inline Mat<V> gradient_of(Vec<V> const* d, Vec<V> const* g) {
  return {d[0].x * g[0] + d[1].x * g[1] + d[2].x * g[2], d[0].y * g[0] + d[1].y * g[1] + d[2].y * g[2],
          d[0].z * g[0] + d[1].z * g[1] + d[2].z * g[2]};
}
template <class V> inline Vec<V> times(Mat<V> const& m, Vec<V> v) {
  return {core::dot(m.x, v), core::dot(m.y, v), core::dot(m.z, v)};
}

/// First Piola-Kirchhoff stress of the hyperelastic law: G F + s cof F, with C = cof F and J = det F.
template <class V> inline Mat<V> hyperelastic_stress(Mat<V> const& F, Mat<V> const& C, V J, V G, V lambda) {
  V const one(1.0), half(0.5), s = (half * lambda * (J * J - one) - G) / J;
  return {G * F.x + s * C.x, G * F.y + s * C.y, G * F.z + s * C.z};
}

/// The same of the law `paper`: T cof F with the stress T of Eq. 6.
template <class V> inline Mat<V> paper_stress(Mat<V> const& F, Mat<V> const& C, V G, V lambda) {
  V const one(1.0), half(0.5);
  V const exx = half * (core::dot(F.x, F.x) - one), eyy = half * (core::dot(F.y, F.y) - one);
  V const ezz = half * (core::dot(F.z, F.z) - one), mean = lambda * (exx + eyy + ezz), G2 = G + G;
  V const txy = G * core::dot(F.x, F.y), txz = G * core::dot(F.x, F.z), tyz = G * core::dot(F.y, F.z);
  V const txx = G2 * exx + mean, tyy = G2 * eyy + mean, tzz = G2 * ezz + mean;
  return {txx * C.x + txy * C.y + txz * C.z, txy * C.x + tyy * C.y + tyz * C.z,
          txz * C.x + tyz * C.y + tzz * C.z};
}

/// Which laws the tets of a pack follow.
enum class PackLaw { hyperelastic, paper, mixed };

/// One pack of tets on its way through the step.
template <class V> struct TetPack {
  TetPass const& pass;
  std::size_t block;
  int lane0;
  Vec<V> u[4], v[4], f[4];

  TetPack(TetPass const& tets, std::size_t of_block, int from_lane)
      : pass(tets), block(of_block), lane0(from_lane) {} // the rest is loaded: to zero it first takes time

  double const* constant(core::Buffer<double> const& b, int components) const {
    return b.data() + block * components * model::block + lane0;
  }
  std::size_t first_tet() const { return block * model::block + lane0; }

  void load_state() {
    core::load_tets<V>(pass.u + core::per_tet * first_tet(), u);
    core::load_tets<V>(pass.v + core::per_tet * first_tet(), v);
  }

  /// Internal forces f_a = -V P grad N_a. Returns the power dissipated by the viscous stress [W].
  template <PackLaw law> V internal_forces() {
    model::TetBlocks const& t = *pass.tets;
    V const one(1.0);
    double const* const gp = constant(t.gradient, 9);
    auto row = [&](int i) { return load<V>(gp + i * model::block); };
    Vec<V> const g[3] = {{row(0), row(1), row(2)}, {row(3), row(4), row(5)}, {row(6), row(7), row(8)}};
    double const* const moduli = t.moduli.of_block(block) + lane0;
    V const G = load<V>(moduli), lambda = load<V>(moduli + model::block);
    V const volume = load<V>(constant(t.volume, 1));

    Vec<V> const du[3] = {u[1] - u[0], u[2] - u[0], u[3] - u[0]};
    Mat<V> const H = gradient_of(du, g);
    Mat<V> F = H;
    F.x.x += one, F.y.y += one, F.z.z += one;
    Mat<V> const C{core::cross(F.y, F.z), core::cross(F.z, F.x), core::cross(F.x, F.y)};
    V const J = core::dot(F.x, C.x);

    Mat<V> P;
    if constexpr (law != PackLaw::paper) P = hyperelastic_stress(F, C, J, G, lambda);
    if constexpr (law == PackLaw::paper) P = paper_stress(F, C, G, lambda);
    if constexpr (law == PackLaw::mixed) P = where_paper(paper_stress(F, C, G, lambda), P);
    V power(0.0);
    if (t.any_viscosity) power = add_viscous(P, C, J, g, volume);

    V const minus = -volume;
    for (int a = 0; a < 3; ++a) f[a + 1] = times(P, minus * g[a]);
    f[0] = V(-1.0) * (f[1] + f[2] + f[3]);
    return power;
  }

  std::uint8_t const* paper_marks() const {
    return pass.tets->is_paper.data() + block * model::block + lane0;
  }
  PackLaw law() const {
    std::uint8_t const* const is_paper = paper_marks();
    int paper = 0;
    for (int i = 0; i < core::lanes<V>; ++i) paper += is_paper[i];
    return paper == 0 ? PackLaw::hyperelastic : paper == core::lanes<V> ? PackLaw::paper : PackLaw::mixed;
  }
  /// Each tet takes the stress of its own law.
  Mat<V> where_paper(Mat<V> const& paper, Mat<V> const& other) const {
    std::uint8_t const* const is_paper = paper_marks();
    double one_if[core::lanes<V>];
    for (int i = 0; i < core::lanes<V>; ++i) one_if[i] = is_paper[i];
    auto const here = load<V>(one_if) > V(0.0);
    auto pick = [&](Vec<V> const& a, Vec<V> const& b) {
      return Vec<V>{core::choose(here, a.x, b.x), core::choose(here, a.y, b.y), core::choose(here, a.z, b.z)};
    };
    return {pick(paper.x, other.x), pick(paper.y, other.y), pick(paper.z, other.z)};
  }

  V forces_of_own_law() {
    switch (law()) {
    case PackLaw::hyperelastic:
      return internal_forces<PackLaw::hyperelastic>();
    case PackLaw::paper:
      return internal_forces<PackLaw::paper>();
    default:
      return internal_forces<PackLaw::mixed>();
    }
  }

  /// mu_bar D of Eq. 8 with L = Fdot F^-1, evaluated at the last half step. Returns its power V J mu D : D.
  V add_viscous(Mat<V>& P, Mat<V> const& C, V J, Vec<V> const* g, V volume) {
    V const mu = load<V>(pass.tets->moduli.of_block(block) + 2 * model::block + lane0), half(0.5);
    Vec<V> const dv[3] = {v[1] - v[0], v[2] - v[0], v[3] - v[0]};
    Mat<V> const Fdot = gradient_of(dv, g);
    V const inv = V(1.0) / J;
    // F^-1 = C^T/J: L_ij = Fdot_i . C_j / J
    V const dxx = inv * core::dot(Fdot.x, C.x), dyy = inv * core::dot(Fdot.y, C.y),
            dzz = inv * core::dot(Fdot.z, C.z);
    V const dxy = half * inv * (core::dot(Fdot.x, C.y) + core::dot(Fdot.y, C.x));
    V const dxz = half * inv * (core::dot(Fdot.x, C.z) + core::dot(Fdot.z, C.x));
    V const dyz = half * inv * (core::dot(Fdot.y, C.z) + core::dot(Fdot.z, C.y));
    P.x = P.x + mu * (dxx * C.x + dxy * C.y + dxz * C.z);
    P.y = P.y + mu * (dxy * C.x + dyy * C.y + dyz * C.z);
    P.z = P.z + mu * (dxz * C.x + dyz * C.y + dzz * C.z);
    V const two(2.0);
    return volume * J * mu * (dxx * dxx + dyy * dyy + dzz * dzz + two * (dxy * dxy + dxz * dxz + dyz * dyz));
  }

  void gather_joint_forces() {
    int const* const where = pass.joints->place.data() + block * 12 * model::block + lane0;
    float const* const sign = pass.joints->sign.data() + block * 4 * model::block + lane0;
    double const* const force = pass.joints->force.data();
    for (int face = 0; face < 4; ++face) {
      V const s = load<V>(sign + face * model::block);
      for (int k = 0; k < 3; ++k) {
        int const a = mesh::face_corners[face][k];
        f[a] = f[a] + s * core::load_vectors<V>(force, where + (3 * face + k) * model::block);
      }
    }
  }

  void add_overlay() {
    if (!pass.overlay->in_block[block]) return;
    for (int i = 0; i < core::lanes<V>; ++i) {
      int const slot = pass.overlay->slot_of_tet[block * model::block + lane0 + i];
      if (slot < 0) continue;
      double const* const o = pass.overlay->at(slot);
      for (int a = 0; a < 4; ++a) {
        add_lane(f[a].x, i, o[core::per_node * a]);
        add_lane(f[a].y, i, o[core::per_node * a + 1]);
        add_lane(f[a].z, i, o[core::per_node * a + 2]);
      }
    }
  }
  static void add_lane(V& value, int i, double add) {
    if constexpr (std::is_same_v<V, double>)
      value += add;
    else
      value[i] = value[i] + add;
  }

  /// Into room that begins with the forces of block `begin`.
  void store_corner_forces(std::size_t begin) {
    core::store_tets<V>(pass.corner_force + core::per_tet * (first_tet() - model::block * begin), f);
  }

  /// Central differences, Eq. 1: v(n-1/2), u(n) -> v(n+1/2), u(n+1), with mass-proportional and local
  /// damping.
  void integrate(V (&sums)[4]) {
    V const zero(0.0), half(0.5), dt(pass.dt), alpha(pass.local_damping);
    V const ratio = pass.tets->any_scaled ? load<V>(constant(pass.tets->weight_ratio, 1)) : V(1.0);
    V const keep(1 - 0.5 * pass.mass_damping * pass.dt), scale(1 / (1 + 0.5 * pass.mass_damping * pass.dt));
    Vec<V> const g{V(pass.gravity.x) * ratio, V(pass.gravity.y) * ratio, V(pass.gravity.z) * ratio};
    Vec<V> const gm{V(pass.gravity_mean.x) * ratio, V(pass.gravity_mean.y) * ratio,
                    V(pass.gravity_mean.z) * ratio};
    double const* const im = constant(pass.tets->inverse_mass, 4);
    for (int a = 0; a < 4; ++a) {
      V const inverse = load<V>(im + a * model::block);
      V const mass = core::choose(inverse > zero, V(V(1.0) / inverse), zero);
      Vec<V> acc = inverse * f[a] + g;
      Vec<V> const old = v[a];
      Vec<V> lost{zero, zero, zero};
      if (pass.local_damping > 0) {
        auto damp = [&](V& r, V w) {
          V const d = alpha * core::absolute(r);
          V const sense = core::choose(w > zero, V(1.0), core::choose(w < zero, V(-1.0), zero));
          r -= d * sense;
          return V(d * sense);
        };
        lost = {damp(acc.x, old.x), damp(acc.y, old.y), damp(acc.z, old.z)};
      }
      v[a] = scale * (keep * old + dt * acc);
      u[a] = u[a] + dt * v[a];
      Vec<V> const mid = half * (old + v[a]); // the velocity at n: what forces at n do work on
      sums[0] += half * mass * core::dot(mid, mid);
      sums[1] += mass * core::dot(lost, mid);
      sums[2] += mass * core::dot(gm, v[a]);
      if (pass.reads_energy) {
        Vec<V> const change = v[a] - old;
        sums[3] += V(0.125) * mass * core::dot(change, change);
      }
    }
    core::store_tets<V>(pass.u + core::per_tet * first_tet(), u);
    core::store_tets<V>(pass.v + core::per_tet * first_tet(), v);
  }
};

/// Fetches what the next packs of a range need, two blocks ahead: displacements and velocities, which are
/// mostly written too, and the forces of joints, which may lie anywhere. Always inline: else gcc takes it for
/// a function without any effect and drops the calls.
[[gnu::always_inline]] inline void prefetch_block(TetPass const& pass, std::size_t b, std::size_t end) {
  constexpr std::size_t ahead = 2, line = 8; // doubles of a cache line
  if (b + ahead >= end) return;
  std::size_t const first = core::per_tet * model::block * (b + ahead);
  for (std::size_t i = first; i < first + core::per_tet * model::block; i += line) {
    __builtin_prefetch(pass.u + i, core::to_write);
    __builtin_prefetch(pass.v + i, core::to_write);
  }
  int const* const where = pass.joints->place.data() + (b + ahead) * 12 * model::block;
  for (int face = 0; face < 4; ++face)
    for (int i = 0; i < model::block; ++i) {
      int const* const corner = where + 3 * face * model::block + i;
      int const start = std::min({corner[0], corner[model::block], corner[2 * model::block]});
      __builtin_prefetch(pass.joints->force.data() + start);
      __builtin_prefetch(pass.joints->force.data() + start + line); // nine numbers span two lines
    }
}

template <class V> state::TetSums tet_forces(TetPass const& pass, std::size_t begin, std::size_t end) {
  V viscous(0.0), sums[4] = {V(0.0), V(0.0), V(0.0), V(0.0)};
  for (std::size_t b = begin; b < end; ++b) {
    prefetch_block(pass, b, end);
    for (int lane = 0; lane < model::block; lane += core::lanes<V>) {
      TetPack<V> p(pass, b, lane);
      p.load_state();
      viscous += p.forces_of_own_law();
      p.gather_joint_forces();
      p.add_overlay();
      if (pass.corner_force)
        p.store_corner_forces(begin);
      else
        p.integrate(sums);
    }
  }
  state::TetSums r;
  r.viscous = core::sum_lanes(viscous) * pass.dt;
  r.kinetic = {core::sum_lanes(sums[0]), core::sum_lanes(sums[3])};
  r.local_damping = core::sum_lanes(sums[1]) * pass.dt;
  r.gravity = core::sum_lanes(sums[2]) * pass.dt;
  return r;
}

} // namespace FISSURA_ISA
} // namespace fissura::concrete
