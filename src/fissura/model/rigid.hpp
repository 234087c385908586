#pragma once
// Rigid bodies that concrete can touch, and bodies that are in motion at t = 0: resolved from the case.
#include <array>
#include <string>
#include <vector>

#include "fissura/core/error.hpp"
#include "fissura/core/vec3.hpp"

namespace fissura::model {

/// A half space that never moves, or an impactor: a convex solid that moves as a point mass without turning.
struct RigidBody {
  enum class Shape { plane, sphere, cylinder, box };
  core::Place place;
  std::string name;
  Shape shape = Shape::plane;
  Vec3 centre;            ///< at t = 0 [m]; plane: a point of it
  Vec3 axis;              ///< unit vector. plane: out of the rigid half space; cylinder: its axis
  double radius = 0;      ///< sphere, cylinder [m]
  double half_length = 0; ///< cylinder [m]
  Vec3 half;              ///< box: half of its edges, along x, y, z [m]
  double friction = 0;    ///< mu

  bool is_impactor = false;
  double mass = 0;                             ///< [kg]
  Vec3 velocity;                               ///< at t = 0 [m/s]
  std::array<bool, 3> moves{true, true, true}; ///< false: a guide holds this component
};

/// Nodes that move at t = 0.
struct InitialVelocity {
  std::vector<int> nodes; ///< ascending
  Vec3 velocity;          ///< [m/s]
};

} // namespace fissura::model
