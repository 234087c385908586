#include "fissura/contact/rigid_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fissura::contact {

using model::RigidBody;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Some unit vector across a unit vector.
Vec3 across(Vec3 axis) {
  Vec3 const help = std::abs(axis.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return unit(cross(axis, help));
}

Distance to_sphere(RigidBody const& b, Vec3 r) {
  double const length = norm(r);
  return {length - b.radius, length > 0 ? r / length : Vec3{0, 0, 1}};
}

Distance to_cylinder(RigidBody const& b, Vec3 r) {
  double const along = dot(r, b.axis);
  Vec3 const radial = r - along * b.axis;
  double const from_axis = norm(radial);
  double const side = from_axis - b.radius, end = std::abs(along) - b.half_length;
  Vec3 const outwards = from_axis > 0 ? radial / from_axis : across(b.axis);
  Vec3 const endwards = along < 0 ? -b.axis : b.axis;
  if (side > 0 && end > 0) {
    double const d = std::hypot(side, end);
    return {d, (side / d) * outwards + (end / d) * endwards};
  }
  return side > end ? Distance{side, outwards} : Distance{end, endwards};
}

Distance to_box(RigidBody const& b, Vec3 r) {
  Vec3 outside;
  int nearest = 0;
  double inside = -infinite;
  for (int i = 0; i < 3; ++i) {
    double const q = std::abs(r[i]) - b.half[i], sense = r[i] < 0 ? -1 : 1;
    if (q > 0) outside[i] = sense * q;
    if (q > inside) inside = q, nearest = i;
  }
  if (inside > 0) {
    double const d = norm(outside);
    return {d, outside / d};
  }
  Vec3 normal;
  normal[nearest] = r[nearest] < 0 ? -1 : 1;
  return {inside, normal};
}

} // namespace

Distance distance(RigidBody const& b, Vec3 x) {
  Vec3 const r = x - b.centre;
  switch (b.shape) {
  case RigidBody::Shape::plane:
    return {dot(r, b.axis), b.axis};
  case RigidBody::Shape::sphere:
    return to_sphere(b, r);
  case RigidBody::Shape::cylinder:
    return to_cylinder(b, r);
  case RigidBody::Shape::box:
    break;
  }
  return to_box(b, r);
}

double touchable_area(RigidBody const& b) {
  constexpr double pi = std::numbers::pi;
  switch (b.shape) {
  case RigidBody::Shape::plane:
    return infinite;
  case RigidBody::Shape::sphere:
    return 2 * pi * b.radius * b.radius;
  case RigidBody::Shape::cylinder:
    return pi * b.radius * (b.radius + 2 * b.half_length);
  case RigidBody::Shape::box:
    break;
  }
  return 4 * (b.half.x * b.half.y + b.half.y * b.half.z + b.half.z * b.half.x);
}

double smallest_half_extent(RigidBody const& b) {
  switch (b.shape) {
  case RigidBody::Shape::plane:
    return infinite;
  case RigidBody::Shape::sphere:
    return b.radius;
  case RigidBody::Shape::cylinder:
    return std::min(b.radius, b.half_length);
  case RigidBody::Shape::box:
    break;
  }
  return std::min({b.half.x, b.half.y, b.half.z});
}

} // namespace fissura::contact
