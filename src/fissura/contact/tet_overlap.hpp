#pragma once
// The potential of two overlapping tets, after the idea of Munjiza and Andrews (2000): each tet carries a
// potential phi = min over its faces f of H_f lambda_f, the depth below the nearest face (lambda_f:
// barycentric coordinate, H_f: reference altitude, so that phi moves with the material). The energy of a pair
// is
//   E = k [ integral of phi_a over b's part inside a + integral of phi_b over a's part inside b ],
// volumes measured in the reference state of the tet that is pressed into the other. phi vanishes on all
// faces, so the forces below are exactly minus the gradient of E with respect to the corners of both tets:
// contact without friction conserves energy, linear and angular momentum, whatever touches what. Two flat
// faces that overlap by g over an area A: E = k A g^2, a pressure of 2 k g.
#include <array>
#include <cstdint>

#include "fissura/core/vec3.hpp"

namespace fissura::contact {

/// A tet as it is now.
struct TetNow {
  std::array<Vec3, 4> x;          ///< corners [m]
  std::array<Vec3, 4> gradient;   ///< of the barycentric coordinates [1/m]
  std::array<double, 4> altitude; ///< in the reference state [m]
  double volume_ratio = 1;        ///< current volume over reference volume

  /// Barycentric coordinate c of a point.
  double lambda(int c, Vec3 point) const { return dot(gradient[c], point - x[(c + 1) % 4]); }
};

/// `reference` gives the altitudes and the volume. A tet that is inside out or flat gets zero gradients: it
/// has no inside and touches nothing.
TetNow make_tet_now(std::array<Vec3, 4> const& now, std::array<Vec3, 4> const& reference);

/// A quick test: some face of one tet has all corners of the other on its outer side. `separator` is the face
/// to try first, 0-3 of a, 4-7 of b; it is set to the one that was found.
bool are_apart(std::array<Vec3, 4> const& a, std::array<Vec3, 4> const& b, std::uint8_t& separator);

/// A lower bound of the distance of two tets [m]: the widest gap between their shadows on a normal of a face
/// or of a pair of edges. 0 if and only if they touch or overlap (of tets with a volume).
double gap_between(std::array<Vec3, 4> const& a, std::array<Vec3, 4> const& b);

struct TetOverlap {
  double volume = 0;                  ///< of the common part [m3]
  Vec3 centroid;                      ///< of the common part [m]
  double energy = 0;                  ///< E/k [m4]
  Vec3 force;                         ///< on b, its opposite on a: over k [m3]
  std::array<Vec3, 4> on_a{}, on_b{}; ///< forces on the corners over k [m3]
};

/// Volume 0 where the tets do not overlap.
TetOverlap overlap(TetNow const& a, TetNow const& b);

} // namespace fissura::contact
