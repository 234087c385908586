#include <cmath>

#include "fissura/motion/kernels.hpp"
#include "fissura/motion/points.hpp"
#include "fissura/parallel/parallel.hpp"

namespace fissura::motion {

using model::Model;
using state::PointRows;
using state::State;
using state::TetSums;

namespace {

constexpr std::size_t points_per_chunk = 256; // the unit of work and of summation

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}
double sign(double x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// One pass over a range of points.
class Mover {
 public:
  Mover(Model const& m, State& s, state::Scratch const& w, Motion const& motion, std::span<double> reaction)
      : m_(m), p_(m.points), s_(s), rows_(w.points), force_(w.corner_force), g_(motion.gravity),
        gm_(motion.gravity_mean), reads_energy_(motion.reads_energy), driven_(motion.driven),
        reaction_(reaction), dt_(m.dt) {
    auto const& stage = m.stages[s.stage];
    keep_ = 1 - 0.5 * stage.mass_damping * dt_, scale_ = 1 / (1 + 0.5 * stage.mass_damping * dt_);
    alpha_ = stage.local_damping;
  }

  /// Points side by side that nothing drives or has split go through the kernel together.
  void move(std::size_t begin, std::size_t end) {
    PointPass const pass{p_.first.data(),
                         p_.leader.data(),
                         rows_.row.data(),
                         rows_.weight.data(),
                         rows_.per_pull.data(),
                         rows_.per_mu.data(),
                         force_.data(),
                         s_.u.data(),
                         s_.v.data(),
                         dt_,
                         keep_,
                         scale_,
                         g_,
                         gm_,
                         reads_energy_};
    for (std::size_t p = begin; p < end;) {
      std::size_t plain = p;
      while (plain < end && is_plain(plain)) ++plain;
      point_kernels().move(pass, p, plain, sums_);
      for (p = plain; p < end && !is_plain(p); ++p)
        for (int part = 0; part < rows_.parts[p]; ++part)
          for (int r = 0; r < 3; ++r) move_part(p, part, r);
    }
  }

  TetSums const& sums() const { return sums_; }

 private:
  int first(int c) const { return p_.leader[idx(c)]; }

  /// Forces on a cluster, with gravity and local damping.
  Vec3 force_on(int c) const {
    Vec3 f = rows_.weight[idx(c)] * g_;
    for (int i = p_.start[idx(c)]; i < p_.start[idx(c + 1)]; ++i) f += force_.at(idx(p_.node[idx(i)]));
    if (alpha_ > 0) {
      double const* const v = s_.v.of_node(idx(first(c)));
      for (int r = 0; r < 3; ++r) f[r] -= alpha_ * std::abs(f[r]) * sign(v[r]);
    }
    return f;
  }
  /// What local damping takes of a force f that it has been part of.
  double damped(double f, double v) const {
    double const sense = sign(v) * sign(f);
    return alpha_ * std::abs(f) / (1 - alpha_ * sense); // |f| before damping
  }

  void put(int c, int r, double v) {
    for (int i = p_.start[idx(c)]; i < p_.start[idx(c + 1)]; ++i) {
      std::size_t const node = idx(p_.node[idx(i)]);
      s_.v(node, r) = v;
      s_.u(node, r) += dt_ * v;
    }
  }

  bool is_plain(std::size_t point) const {
    int const from = p_.first[point], to = p_.first[point + 1];
    return alpha_ == 0 && p_.held[point] < 0 && rows_.parts[point] == 1 &&
           p_.start[idx(to)] - p_.start[idx(from)] == to - from;
  }

  /// The prescribed motion of a cluster along an axis, or -1.
  int prescribed(std::size_t point, int c, int r) const {
    if (p_.held[point] < 0) return -1;
    int const k = p_.prescribed[idx(p_.held[point] + c - p_.first[point])][idx(r)];
    return k >= 0 && m_.prescribed[idx(k)].motion.stage <= s_.stage ? k : -1;
  }

  /// One part of a point along one axis, with clusters that are driven.
  void move_part(std::size_t point, int part, int r) {
    int const from = p_.first[point], to = p_.first[point + 1];
    auto const driven_to = [&](int k, double old) { return (driven_[idx(k)] / scale_ - keep_ * old) / dt_; };
    double top = 0, below = 0;
    for (int c = from; c < to; ++c) {
      if (rows_.part[idx(c)] != part) continue;
      auto const& row = rows_.row[idx(c)];
      if (int const k = prescribed(point, c, r); k >= 0)
        top += row.mu * driven_to(k, s_.v(idx(first(c)), r)), below += row.mu;
      else
        top += row.beta * force_on(c)[r], below += row.beta * rows_.mass[idx(c)];
    }
    double const common = below > 0 ? top / below : 0;
    double mean = 0, change = 0, mu = 0, at_n = 0, of_change = 0;
    for (int c = from; c < to; ++c) {
      if (rows_.part[idx(c)] != part) continue;
      auto const& row = rows_.row[idx(c)];
      double const old = s_.v(idx(first(c)), r);
      int const k = prescribed(point, c, r);
      double v = 0;
      if (k >= 0) {
        double const a = driven_to(k, old);
        double f = rows_.weight[idx(c)] * g_[r];
        for (int i = p_.start[idx(c)]; i < p_.start[idx(c + 1)]; ++i) f += force_(idx(p_.node[idx(i)]), r);
        reaction_[idx(k)] += rows_.mass[idx(c)] * a + row.mu * (a - common) - f;
        v = driven_[idx(k)];
      } else {
        double const f = force_on(c)[r];
        v = scale_ * (keep_ * old + dt_ * (row.inverse * f + row.beta * common));
        if (alpha_ > 0) sums_.local_damping += damped(f, old) * sign(old) * 0.5 * (old + v) * dt_;
      }
      put(c, r, v);
      double const twice = old + v, step = v - old;
      at_n += row.inertia * twice * twice, of_change += row.inertia * step * step;
      mean += row.mu * twice, change += row.mu * step, mu += row.mu;
      sums_.gravity += rows_.weight[idx(c)] * gm_[r] * v * dt_;
    }
    double const per_mu = mu > 0 ? 1 / mu : 0;
    sums_.kinetic.at_n += 0.125 * (at_n - per_mu * mean * mean);
    sums_.kinetic.of_change += 0.125 * (of_change - per_mu * change * change);
  }

  Model const& m_;
  model::Points const& p_;
  State& s_;
  PointRows const& rows_;
  core::NodeField const& force_;
  Vec3 g_, gm_;
  bool reads_energy_;
  std::span<double const> driven_;
  std::span<double> reaction_;
  double dt_, keep_, scale_, alpha_;
  TetSums sums_;
};

} // namespace

TetSums move_points(Model const& m, State& s, state::Scratch& w, Motion const& motion,
                    TetForces const& tet_forces) {
  constexpr std::size_t blocks_per_part = model::Points::tets_per_part / model::block;
  auto const& of_part = m.points.of_part;
  auto const first_shared = static_cast<std::size_t>(of_part.back());
  std::size_t const kinds = m.prescribed.size(), parts = of_part.size() - 1,
                    shared = m.points.count() - first_shared,
                    sums = parts + parallel::chunks(shared, points_per_chunk);
  auto &part_reaction = w.points.part_reaction, &reaction = w.points.reaction;
  part_reaction.assign(sums * kinds, 0), reaction.assign(kinds, 0);
  auto const move = [&](std::size_t sum, std::size_t begin, std::size_t end) {
    Mover mover(m, s, w, motion, {part_reaction.data() + sum * kinds, kinds});
    mover.move(begin, end);
    w.tet_sums[sum] += mover.sums();
  };
  parallel::for_chunks(
      m.tets.blocks(), blocks_per_part, [&](std::size_t part, std::size_t begin, std::size_t end) {
        w.tet_sums[part] = tet_forces(begin, end);
        move(part, static_cast<std::size_t>(of_part[part]), static_cast<std::size_t>(of_part[part + 1]));
      });
  parallel::for_chunks(shared, points_per_chunk, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    w.tet_sums[parts + chunk] = {};
    move(parts + chunk, first_shared + begin, first_shared + end);
  });
  TetSums total;
  for (std::size_t i = 0; i < sums; ++i) {
    total += w.tet_sums[i];
    for (std::size_t k = 0; k < kinds; ++k) reaction[k] += part_reaction[i * kinds + k];
  }
  return total;
}

} // namespace fissura::motion
