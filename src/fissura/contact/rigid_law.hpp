#pragma once
// The law at one quadrature point of a face that presses against a rigid body: a linear spring along the
// normal and Coulomb friction with a tangential spring across it.
//
//   p = k_n (g - g_0) for g > g_0, else 0           stored 1/2 k_n (g - g_0)^2 per area
//   t = -k_t e, |t| <= mu p                         stored 1/2 k_t e^2 per area
//
// g [m] is the penetration, > 0 inside. g_0 is the penetration a point was found with when its face came free
// inside the body; it follows g down and never rises, so that nothing is created. e [m] is the stretch of
// the tangential spring: what the concrete has moved relative to the body, less what of it was slip.
// Parameters: k_n > 0 [Pa/m], k_t = 2/7 k_n (the usual choice: a solid sphere that sticks then swings with
// one period in both directions), mu >= 0 [-].
#include <algorithm>

#include "fissura/core/vec3.hpp"

namespace fissura::contact {

struct RigidLaw {
  double k_n = 0;      ///< [Pa/m]
  double friction = 0; ///< mu
  double k_t() const { return 2.0 / 7.0 * k_n; }
};

/// What a point remembers from one step to the next.
struct RigidMemory {
  double offset = 0; ///< g_0 [m]
  Vec3 stretch;      ///< e [m]
};

struct RigidTraction {
  Vec3 on_concrete; ///< [Pa]
  double lost = 0;  ///< to friction over the last step [J/m2]
};

/// A vector turned into the plane across `normal`, its length kept: the spring follows the surface.
inline Vec3 turned_into_plane(Vec3 e, Vec3 normal) {
  Vec3 const flat = e - dot(e, normal) * normal;
  double const now = norm(flat);
  return now == 0 ? Vec3{} : (norm(e) / now) * flat; // so that a NaN is not lost
}

/// Traction of a point at penetration g > 0 that has moved by `step` [m] relative to the body since the last
/// step; the memory moves on. Slip is paid for with the mean of the tractions before and after: what the
/// central differences take out of the motion.
inline RigidTraction rigid_traction(RigidLaw const& law, RigidMemory& memory, double g, Vec3 normal,
                                    Vec3 step) {
  memory.offset = std::min(memory.offset, g);
  double const pressure = law.k_n * (g - memory.offset), k_t = law.k_t();
  Vec3 const before = turned_into_plane(memory.stretch, normal);
  Vec3 const trial = before + (step - dot(step, normal) * normal);
  double const most = law.friction * pressure / k_t, length = norm(trial);
  memory.stretch = length > most ? (most / length) * trial : trial;
  Vec3 const slip = trial - memory.stretch;
  return {pressure * normal - k_t * memory.stretch, 0.5 * k_t * dot(before + memory.stretch, slip)};
}

/// Stored energy of a point [J/m2].
inline double rigid_stored(RigidLaw const& law, RigidMemory const& memory, double g) {
  double const pressed = std::max(0.0, g - memory.offset);
  return 0.5 * law.k_n * pressed * pressed + 0.5 * law.k_t() * dot(memory.stretch, memory.stretch);
}

} // namespace fissura::contact
