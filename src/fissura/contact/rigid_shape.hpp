#pragma once
// The shapes of rigid bodies as signed distance functions.
#include "fissura/model/rigid.hpp"

namespace fissura::contact {

/// Distance of a place from the surface of a body, < 0 inside [m], and its gradient: the unit normal that
/// points out of the body.
struct Distance {
  double value = 0;
  Vec3 normal;
};

/// Of the place x, measured where the body stood at t = 0 (subtract its displacement first).
Distance distance(model::RigidBody const& body, Vec3 x);

/// The largest area concrete can touch at a time: half of the body's surface [m2]; infinite for a plane.
double touchable_area(model::RigidBody const& body);

/// Its smallest half extent [m]: what must not fall between two quadrature points; infinite for a plane.
double smallest_half_extent(model::RigidBody const& body);

} // namespace fissura::contact
