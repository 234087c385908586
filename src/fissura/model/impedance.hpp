#pragma once
// Wave impedance of a material whose joints soften it.
#include <array>

#include "fissura/model/model.hpp"

namespace fissura::model {

/// Symmetric tensors as six numbers xx yy zz xy yz zx, the shear components times sqrt(2): a product of two
/// tensors is that of their numbers.
using Six = std::array<double, 6>;
using SixBySix = std::array<Six, 6>;

/// Elastic stiffness [Pa] of a concrete as the mesh makes it: tets and joints in series under a uniform
/// stress, by the mean fabric of its joints. `concrete` is an index into Case::concretes.
SixBySix jointed_stiffness(Model const& m, int concrete);

/// Acoustic tensor n.C.n [Pa].
Mat3 acoustic_tensor(SixBySix const& stiffness, Vec3 n);

/// sqrt(density) times the root of an acoustic tensor [Pa s/m]: traction = -impedance velocity in a plane
/// wave. For an isotropic body rho c_p along n and rho c_s across it.
Mat3 impedance(Mat3 const& acoustic, double density);

} // namespace fissura::model
