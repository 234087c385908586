#pragma once
// What changes in time in the contact with rigid bodies, and the work arrays of its pass.
#include <array>
#include <cstdint>
#include <vector>

#include "fissura/core/vec3.hpp"

namespace fissura::state {

/// A quadrature point of a free face that lies inside a rigid body.
struct RigidTouch {
  int tet = -1;
  std::uint8_t face = 0, point = 0;
  std::uint16_t body = 0; ///< index into Model::rigid
  double offset = 0;      ///< penetration that carries no force [m]: found when the face came free
  Vec3 stretch;           ///< of the tangential spring: concrete relative to the body [m]
};

struct RigidState {
  struct Body {
    Vec3 u, v;    ///< displacement at n [m], velocity at n - 1/2 [m/s]
    Vec3 force;   ///< of the body on the concrete at the last n [N]
    Vec3 impulse; ///< its sum over the steps [N s]
  };
  std::vector<Body> body;        ///< per Model::rigid
  std::vector<RigidTouch> touch; ///< sorted by tet, face, body, point
};

/// Work arrays of the contact with rigid bodies.
struct RigidScratch {
  /// A free face near a body.
  struct Face {
    int tet;
    std::uint8_t face;
    std::uint16_t body;
    double area;      ///< [m2], reference
    double stiffness; ///< k_n [Pa/m]
  };
  /// The faces of one tet.
  struct Host {
    int tet, slot, begin, end; ///< faces[begin .. end)
  };
  /// What one face found in this step.
  struct Result {
    std::array<RigidTouch, 7> touch;
    int count = 0;   ///< points inside the body
    Vec3 force;      ///< on the concrete [N]
    double lost = 0; ///< to friction [J]
  };
  std::vector<Face> faces; ///< sorted by tet, face, body
  std::vector<Host> hosts;
  std::vector<Result> results;       ///< per face
  std::vector<int> first;            ///< per face: its first entry in RigidState::touch as it was
  std::vector<std::uint8_t> is_near; ///< per tet
  std::vector<int> tets;             ///< near ones, ascending
  std::vector<int> watched;          ///< their joints that have not let go: a free face may come of each
  double skin = 0;                   ///< distance within which faces are listed [m]
  double used = 0;      ///< bound of how far anything may have moved towards a body since then [m]
  long next_check = -1; ///< step at which `used` is looked at again; -1 = never looked
};

} // namespace fissura::state
