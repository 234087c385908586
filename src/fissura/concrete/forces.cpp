#include <array>

#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/damaged_joints.hpp"
#include "fissura/concrete/kernels.hpp"
#include "fissura/parallel/parallel.hpp"

namespace fissura::concrete {

using model::Model;
using state::Scratch;
using state::State;
using state::TetSums;

namespace {

constexpr std::size_t blocks_per_chunk = 32; // 256 tets: the unit of work and of summation
constexpr std::size_t doubles_per_block = core::per_tet * model::block; // of a nodal field

/// Eq. (1) for nodes that move as one: their corner forces are summed in ascending order of the nodes.
TetSums integrate_clusters(Model const& m, State& s, TetPass const& pass, core::NodeField const& corner_force,
                           std::size_t begin, std::size_t end) {
  TetSums sums;
  double const dt = pass.dt, keep = 1 - 0.5 * pass.mass_damping * dt,
               scale = 1 / (1 + 0.5 * pass.mass_damping * dt);
  for (std::size_t c = begin; c < end; ++c) {
    int const from = m.bonding.start[c], to = m.bonding.start[c + 1], first = m.bonding.node[from];
    std::size_t const tet = static_cast<std::size_t>(first / 4);
    double const inverse = m.tets.inverse_mass[model::at(tet, first % 4, 4)], mass = 1 / inverse;
    double weighing =
        0; // the members may be scaled differently: gravity acts on the sum of their real masses
    for (int i = from; i < to; ++i)
      weighing +=
          m.mass[m.bonding.node[i]] * m.tets.weight_ratio[static_cast<std::size_t>(m.bonding.node[i] / 4)];
    double const ratio = weighing * inverse;
    for (int r = 0; r < 3; ++r) {
      double f = 0;
      for (int i = from; i < to; ++i) f += corner_force(m.bonding.node[i], r);
      double const old = s.v(first, r);
      double a = inverse * f + ratio * pass.gravity[r];
      double const damped = pass.local_damping * std::abs(a);
      a -= old > 0 ? damped : old < 0 ? -damped : 0;
      double const v = scale * (keep * old + dt * a), u = s.u(first, r) + dt * v;
      for (int i = from; i < to; ++i) {
        s.v(m.bonding.node[i], r) = v;
        s.u(m.bonding.node[i], r) = u;
      }
      double const sense = old > 0 ? 1 : old < 0 ? -1 : 0;
      sums.local_damping += mass * damped * sense * 0.5 * (old + v) * dt;
      sums.gravity += mass * ratio * pass.gravity_mean[r] * v * dt;
      sums.kinetic.add(mass, old, v);
    }
  }
  return sums;
}

} // namespace

void joint_forces(Model const& m, State& s, Scratch& w) {
  JointPass const pass{&m.joints, s.u.data(), w.joints.force.data(), s.joint_status.data()};
  auto const& set = kernels();
  constexpr std::size_t group = state::JointHistories::group;
  parallel::for_chunks(m.joints.blocks(), group / model::block,
                       [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                         std::array<int, group> fresh;
                         int const count = set.joint_forces(pass, begin, end, fresh.data());
                         damaged_joints(set, m, s, w.joints, chunk, fresh.data(), count);
                       });
}

void corner_forces(Model const& m, State& s, Scratch const& w, TakeForces const& take) {
  auto const run = kernels().tet_forces;
  parallel::for_chunks(
      m.tets.blocks(), blocks_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        alignas(64) std::array<double, blocks_per_chunk * doubles_per_block> force;
        run({&m.tets, s.u.data(), s.v.data(), &w.joints, &w.overlay, force.data(), 0, 0, 0, {}, {}, false},
            begin, end);
        take(4 * model::block * begin, {force.data(), (end - begin) * doubles_per_block});
      });
}

TetSums tet_forces(Model const& m, State& s, Scratch& w, std::size_t begin, std::size_t end) {
  TetPass const pass{&m.tets,   s.u.data(), s.v.data(),
                     &w.joints, &w.overlay, w.corner_force.data() + doubles_per_block * begin,
                     m.dt,      0,          0,
                     {},        {},         false};
  return kernels().tet_forces(pass, begin, end);
}

TetSums tet_forces_and_integrate(Model const& m, State& s, Scratch& w, Vec3 gravity, Vec3 gravity_mean,
                                 bool reads_energy) {
  auto const& stage = m.stages[s.stage];
  TetPass const pass{&m.tets, s.u.data(),         s.v.data(),          &w.joints, &w.overlay,   nullptr,
                     m.dt,    stage.mass_damping, stage.local_damping, gravity,   gravity_mean, reads_energy};
  bool const integrates = !m.bonding.any;
  auto const run = kernels().tet_forces;
  parallel::for_chunks(m.tets.blocks(), blocks_per_chunk,
                       [&](std::size_t chunk, std::size_t begin, std::size_t end) {
                         TetPass here = pass;
                         if (!integrates)
                           here.corner_force = w.corner_force.data() + doubles_per_block * begin;
                         w.tet_sums[chunk] = run(here, begin, end);
                       });
  TetSums total;
  std::size_t const chunks = parallel::chunks(m.tets.blocks(), blocks_per_chunk);
  for (std::size_t c = 0; c < chunks; ++c) total += w.tet_sums[c];
  if (integrates) return total;

  std::size_t const clusters = m.bonding.start.size() - 1, grain = 8 * blocks_per_chunk;
  parallel::for_chunks(clusters, grain, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    w.tet_sums[chunk] = integrate_clusters(m, s, pass, w.corner_force, begin, end);
  });
  for (std::size_t c = 0; c < parallel::chunks(clusters, grain); ++c) total += w.tet_sums[c];
  return total;
}

} // namespace fissura::concrete
