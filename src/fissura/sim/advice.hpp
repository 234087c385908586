#pragma once
// What an engineer with experience would say before the run: few elements over a bent height, a load that
// comes too fast, damping that carries load. Each with its cure.
#include <string>
#include <vector>

#include "fissura/mesh/quality.hpp"
#include "fissura/model/model.hpp"

namespace fissura::sim {

/// Warnings about a model that is otherwise sound. What is meant to be dynamic (impactors, bodies in motion,
/// records, absorbing boundaries) is not told to go slowly.
std::vector<std::string> advice(model::Model const& m, mesh::Quality const& quality);

/// Kinetic energy of a body that moves at `speed` [m/s] over its elastic energy when it cracks in uniaxial
/// tension: (v sqrt(rho E) / f_t)^2.
double speed_share(model::ConcreteSpec const& concrete, double speed);

/// Largest speed that a curve asks for [m/s], of a displacement [m] or a velocity [m/s].
double largest_speed(model::Curve const& curve, bool is_velocity);

} // namespace fissura::sim
