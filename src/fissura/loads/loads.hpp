#pragma once
// Supports, prescribed motion and applied forces (F_ext of Eq. 2), one function per term.
#include <span>
#include <vector>

#include "fissura/model/model.hpp"
#include "fissura/state/state.hpp"

namespace fissura::loads {

/// Value of a stage-bound curve at time t; 0 before its stage starts.
double value_at(model::TimedCurve const& curve, state::State const& s, double t);

/// Acceleration of gravity at time t [m/s2].
Vec3 gravity_at(model::Model const& m, state::State const& s, double t);

/// Adds the applied forces and tractions at u_n to the overlay.
void applied_forces(model::Model const& m, state::State const& s, state::Scratch& w);

/// Work of the applied forces over u_n -> u_(n+1), by the trapezoidal rule in the force [J].
double applied_work(model::Model const& m, state::State const& s);

/// The damping that is in force during the current stage.
model::Stage const& current_stage(model::Model const& m, state::State const& s);

/// Remembers the velocities at n - 1/2 that the dashpots of absorbing boundaries need after the tet pass.
void note_velocities(model::Model const& m, state::State const& s, state::Scratch& w);

/// What the dashpots changed beside u and v: the tet pass had integrated their nodes as free ones.
struct AbsorbingEffects {
  double absorbed = 0;      ///< by the dashpots in this step [J]
  state::Kinetic kinetic;   ///< to add to that of the step
  double gravity = 0;       ///< to add to the work of gravity over u_n -> u_(n+1) [J]
  double local_damping = 0; ///< to add to the local damping [J]
  AbsorbingEffects& operator+=(AbsorbingEffects const& b) {
    absorbed += b.absorbed, kinetic += b.kinetic, gravity += b.gravity, local_damping += b.local_damping;
    return *this;
  }
};

/// Adds the dashpots to the step of their nodes, implicitly by the trapezoidal rule: no change of the stable
/// step.
AbsorbingEffects absorb_waves(model::Model const& m, state::State& s, state::Scratch const& w,
                              Vec3 gravity_mean);

/// Whether a support or motion begins with this step.
bool begins_now(model::Model const& m, state::State const& s);

/// Brings the nodes of supports and motions that begin with this step to rest: whatever they moved with they
/// lose in an impact. Returns the work of it, -m v^2/2 [J]; zero in all other steps.
double take_hold(model::Model const& m, state::State& s);

/// What prescribing velocities changed beside u and v: the tet pass had integrated these nodes as free ones.
struct MotionEffects {
  double work_done = 0;     ///< completes the work of the supports up to u_n [J]
  double work_next = 0;     ///< first half of the work over u_n -> u_(n+1) [J]
  state::Kinetic kinetic;   ///< to add to that of the step
  double gravity = 0;       ///< to add to the work of gravity over u_n -> u_(n+1) [J]
  double local_damping = 0; ///< to add to the local damping [J]
};

/// The velocities at n + 1/2 of all that is prescribed and has begun.
void next_velocities(model::Model const& m, state::State const& s, std::vector<double>& driven);

/// Books the reactions at u_n that those velocities took (State::reaction), where points are moved as a
/// whole.
MotionEffects book_reactions(model::Model const& m, state::State& s, std::span<double const> driven,
                             std::span<double const> reaction);

/// Imposes the prescribed velocities at n + 1/2 and records the reactions at u_n (State::reaction).
MotionEffects move_supports(model::Model const& m, state::State& s, Vec3 gravity_mean);

} // namespace fissura::loads
