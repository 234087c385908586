#pragma once
// The pass over points that nothing drives and nothing has split, compiled once per instruction set.
#include <cstddef>
#include <string_view>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::motion {

struct PointPass {
  int const* first;                 ///< Points::first
  int const* leader;                ///< Points::leader: the copy of a cluster
  state::PointRows::Row const* row; ///< per cluster
  double const* weight;             ///< per cluster: what gravity acts on [kg]
  double const *per_pull, *per_mu;  ///< per point
  double const* force;              ///< of the nodes (a NodeField) [N]
  double *u, *v;                    ///< NodeFields
  double dt, keep, scale;           ///< scale (keep v + dt a) is the velocity after the step
  Vec3 gravity, gravity_mean;       ///< [m/s2]
  bool reads_energy;                ///< the whole of the kinetic energy is asked for
};

/// [begin, end) are points whose clusters have one copy each. Adds to the sums.
struct PointKernels {
  void (*move)(PointPass const&, std::size_t begin, std::size_t end, state::TetSums&);
};

PointKernels const& point_kernels();

} // namespace fissura::motion
