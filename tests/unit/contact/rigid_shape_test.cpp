// Signed distances of the rigid bodies.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "fissura/contact/rigid_shape.hpp"

namespace fissura::contact {
namespace {

using model::RigidBody;
using Shape = RigidBody::Shape;

RigidBody plane() {
  RigidBody b;
  b.centre = {0.1, 0.2, 0.3};
  b.axis = unit(Vec3{1, 2, 3});
  return b;
}
RigidBody sphere() {
  RigidBody b;
  b.shape = Shape::sphere;
  b.centre = {0.1, 0.2, 0.3};
  b.radius = 0.4;
  return b;
}
RigidBody cylinder() {
  RigidBody b;
  b.shape = Shape::cylinder;
  b.centre = {0.1, 0.2, 0.3};
  b.axis = unit(Vec3{2, -1, 1});
  b.radius = 0.3;
  b.half_length = 0.5;
  return b;
}
RigidBody box() {
  RigidBody b;
  b.shape = Shape::box;
  b.centre = {0.1, 0.2, 0.3};
  b.half = {0.3, 0.2, 0.5};
  return b;
}
std::vector<RigidBody> all() {
  return {plane(), sphere(), cylinder(), box()};
}

Vec3 random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> in(-size, size);
  double const x = in(random), y = in(random), z = in(random);
  return {x, y, z};
}

// Requirement: the distance of a place is that to its foot point on the surface, inside and outside: going
// back by it along the normal ends on the surface.
TEST(RigidShape, normal_leads_to_the_surface) {
  std::mt19937 random(1);
  for (auto const& body : all())
    for (int i = 0; i < 2000; ++i) {
      Vec3 const x = body.centre + random_vector(random, 1);
      auto const d = distance(body, x);
      EXPECT_NEAR(norm(d.normal), 1, 1e-14);
      EXPECT_NEAR(distance(body, x - d.value * d.normal).value, 0, 1e-14);
    }
}

// Requirement: the normal is the gradient of the distance, so that the force is that of the energy.
TEST(RigidShape, normal_is_the_gradient) {
  std::mt19937 random(2);
  for (auto const& body : all()) {
    int kinks = 0;
    for (int i = 0; i < 2000; ++i) {
      Vec3 const x = body.centre + random_vector(random, 1);
      Vec3 const e = 1e-6 * unit(random_vector(random, 1));
      double const slope = distance(body, x + e).value - distance(body, x - e).value;
      kinks += std::abs(slope - 2 * dot(distance(body, x).normal, e)) > 1e-10;
    }
    EXPECT_LE(kinks, 2) << "shape " << static_cast<int>(body.shape); // only where two faces are equally near
  }
}

// Requirement: places on the axes have the distance that geometry says, down to the middle of each body.
TEST(RigidShape, has_the_distances_of_geometry) {
  EXPECT_NEAR(distance(sphere(), sphere().centre).value, -0.4, 1e-15);
  EXPECT_NEAR(distance(sphere(), sphere().centre + Vec3{0, 1, 0}).value, 0.6, 1e-15);
  auto const c = cylinder();
  EXPECT_NEAR(distance(c, c.centre).value, -0.3, 1e-15);
  EXPECT_NEAR(distance(c, c.centre + 0.4 * c.axis).value, -0.1, 1e-15);
  EXPECT_NEAR(distance(c, c.centre + 0.8 * c.axis).value, 0.3, 1e-15);
  auto const b = box();
  EXPECT_NEAR(distance(b, b.centre).value, -0.2, 1e-15);
  EXPECT_NEAR(distance(b, b.centre + Vec3{0.6, 0.6, 0}).value, 0.5, 1e-15);
  EXPECT_NEAR(distance(plane(), plane().centre - 2 * plane().axis).value, -2, 1e-15);
}

// Requirement: half of the surface bounds the area concrete can touch.
TEST(RigidShape, knows_half_of_its_surface) {
  double const pi = std::numbers::pi;
  EXPECT_NEAR(touchable_area(sphere()), 2 * pi * 0.16, 1e-14);
  EXPECT_NEAR(touchable_area(cylinder()), pi * 0.09 + pi * 0.3 * 1.0, 1e-14);
  EXPECT_NEAR(touchable_area(box()), 4 * (0.06 + 0.1 + 0.15), 1e-14);
  EXPECT_TRUE(std::isinf(touchable_area(plane())));
  EXPECT_EQ(smallest_half_extent(box()), 0.2);
}

} // namespace
} // namespace fissura::contact
