#pragma once
// From mesh and materials to the blocks of the step.
#include "fissura/model/model.hpp"

namespace fissura::model {

/// Which concrete each tet is made of; throws core::InputError for a volume group without a concrete, a
/// concrete whose group does not exist, or a group claimed twice.
std::vector<int> assign_materials(Case const& c, mesh::Mesh const& mesh);

/// Throws core::Error (input) for 2^27 tets or more: the numbers of their nodes' coordinates would overflow.
void check_tet_count(std::size_t tets);

/// Fills in Model::tets, joints, joint_of_shared_face, bonding, position and mass from source, mesh,
/// adjacency and material_of_tet. Steel mass (Model::steel_mass) is added by add_steel_mass.
void make_blocks(Model& m);

/// Adds the bars' mass to the nodes [kg per node] and renews the inverse masses.
void add_steel_mass(Model& m, std::span<double const> steel_mass);

/// Selective mass scaling: multiplies the mass of each tet (its steel included); gravity still acts on the
/// real mass.
void scale_masses(Model& m, std::span<double const> factor);

/// 73 f_cm^0.18 N/m with f_cm in MPa (fib Model Code 2010).
double default_fracture_energy(double f_c);
/// c = f_c (1 - sin phi)/(2 cos phi): the Mohr-Coulomb line that meets f_c in uniaxial compression.
double default_cohesion(double f_c, double friction_angle);

} // namespace fissura::model
