#pragma once
// How fast a tet alone can vibrate.
#include <array>

#include "fissura/model/model.hpp"

namespace fissura::step {

/// Reference gradients of the four shape functions of a tet [1/m].
std::array<Vec3, 4> shape_gradients(model::Model const& m, std::size_t tet);

/// Upper bound of omega^2 [1/s2] of a tet whose corners have the masses [kg]: of the largest eigenvalue of
/// V D^1/2 B M^-1 B^T D^1/2 (D the elastic matrix of Eq. 8 at small strain, B the strains per displacement),
/// at most 6 % above it.
double elastic_bound(model::Model const& m, std::size_t tet, std::array<double, 4> const& mass);

/// The same for the viscous matrix of mu_bar [1/s].
double viscous_bound(model::Model const& m, std::size_t tet, std::array<double, 4> const& mass);

} // namespace fissura::step
