#pragma once
// Eq. (1) for models whose joints carry inertia: the copies of a point are moved together.
//
// The kinetic energy of a point whose clusters have masses m_i and velocities v_i is
//
//   1/2 sum m_i v_i^2 + 1/2 [sum mu_i v_i^2 - (sum mu_i v_i)^2/sum mu_i]
//
// The second part is the joint inertia: it is zero while the copies move alike, so that a body keeps its
// mass, its weight and its waves, and it grows with the speed at which they part. With mu_i >= 2 d_i/r, d_i
// the stiffness that joints put on the cluster, no joint vibrates faster than r^1/2, however stiff it is: the
// time step is that of the body behind the joints. The matrix is inverted in closed form, by two sums a
// point:
//
//   c = sum beta_i f_i/sum beta_i m_i,   a_i = (f_i + mu_i c)/(m_i + mu_i),   beta_i = mu_i/(m_i + mu_i)
//
// sum m_i a_i = sum f_i to rounding. Clusters that are driven (supports, motions) enter with the acceleration
// they must have instead of a force; the rest of the point follows them.
// The idea is that of bipenalty methods: Hetherington and Askes, Comput. Methods Appl. Mech. Engrg. (2014), a
// mass matrix for cohesive surfaces. Theory and bounds: docs/theory/joint_inertia.md.
#include <functional>
#include <span>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::motion {

/// mu r/d. 2 would do for joints that stay closed or open: no joint is then faster than r^1/2. Those that
/// open and close under pressure meet a resonance at three steps a period, 0.87 of the stable step
/// (docs/decisions/019-share-of-the-stable-step.md); with 3 they stay below 0.82 of it.
inline constexpr double joint_share = 3;

/// The rows of all points, from the joints that are not released; empty without joint inertia.
state::PointRows make_rows(model::Model const& m, state::State const& s);

/// Looks after joints that have been released since the last call: copies that no joint holds together any
/// more, and no bar, are free of each other. Velocities at n - 1/2 stay. Returns the kinetic energy that
/// vanishes with them, >= 0 [J].
double drop_released(model::Model const& m, state::State const& s, state::Scratch& w);

/// Leaves the corner forces of the blocks [begin, end) of tets in Scratch and returns what they dissipate.
using TetForces = std::function<state::TetSums(std::size_t begin, std::size_t end)>;

/// What moves points beside the forces of their tets.
struct Motion {
  Vec3 gravity, gravity_mean;     ///< [m/s2]
  std::span<double const> driven; ///< per Model::prescribed: the velocity at n + 1/2 [m/s]
  bool reads_energy = false;      ///< the whole of the kinetic energy is asked for
};

/// Forces of all tets, and v(n-1/2), u(n) -> v(n+1/2), u(n+1): part by part, so that the points of a part are
/// moved while its forces are at hand, and those that parts share afterwards. Prescribed components get
/// `driven`; what that takes at u_n is left in PointRows::reaction. Returns what the step dissipated, and the
/// kinetic energy with the joints' inertia, whole only with `reads_energy`.
state::TetSums move_points(model::Model const& m, state::State& s, state::Scratch& w, Motion const& motion,
                           TetForces const& tet_forces);

/// Kinetic energy of joint inertia at the velocities of `s` [J].
double relative_energy(model::Model const& m, state::State const& s, state::PointRows const& rows);

} // namespace fissura::motion
