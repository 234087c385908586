#pragma once
// The immutable problem: mesh, laws, bars, loads and run settings. Everything that changes in time is in
// state/.
#include <string>
#include <vector>

#include "fissura/core/node_field.hpp"
#include "fissura/mesh/mesh.hpp"
#include "fissura/model/bars.hpp"
#include "fissura/model/blocks.hpp"
#include "fissura/model/case.hpp"
#include "fissura/model/loads.hpp"
#include "fissura/model/points.hpp"
#include "fissura/model/rigid.hpp"

namespace fissura::model {

struct Model {
  Case source;
  mesh::Mesh mesh;
  mesh::Adjacency adjacency;
  std::vector<int> material_of_tet; ///< index into source.concretes
  core::NodeField position;         ///< reference positions of the nodes [m]
  core::Buffer<double> mass;        ///< per node: its own share [kg], with density factor
  core::Buffer<double> steel_mass;  ///< per node: the bars' part of it [kg]
  TetBlocks tets;
  JointBlocks joints;
  std::vector<int> joint_of_shared_face; ///< -1 where bonded
  Bonding bonding;
  Points points; ///< with joint inertia, else empty
  Bars bars;

  std::vector<Prescribed> prescribed;
  std::vector<MotionPath> paths;
  std::vector<AppliedForce> forces;
  Absorbing absorbing;
  Gravity gravity;
  std::vector<RigidBody> rigid; ///< planes first, then impactors, in the order of the deck
  std::vector<InitialVelocity> initial_velocity;
  std::vector<Stage> stages;
  std::vector<int> overlay_tets; ///< tets that bars or applied forces act on, ascending

  double dt = 0; ///< [s]
  std::string dt_limiter;
  double added_mass = 0; ///< by density factors [kg]
  double total_mass = 0; ///< without them [kg]

  int tet_count() const { return tets.count; }
  int joint_count() const { return joints.count; }
};

} // namespace fissura::model
