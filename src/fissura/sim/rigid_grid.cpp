// Surfaces of planes and impactors as triangles, for the eye: round shapes are facetted.
#include <cmath>
#include <numbers>

#include "fissura/sim/fields.hpp"

namespace fissura::sim {

using model::Model;
using model::RigidBody;
using output::Grid;

namespace {

constexpr int around = 36, upwards = 18; // facets of a round shape

/// Three unit vectors at right angles, the last one given.
struct Frame {
  Vec3 a, b, c;
  explicit Frame(Vec3 axis) : c(axis) {
    Vec3 const help = std::abs(axis.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    a = unit(cross(help, axis));
    b = cross(axis, a);
  }
  Vec3 circle(int i) const {
    double const angle = 2 * std::numbers::pi * i / around;
    return std::cos(angle) * a + std::sin(angle) * b;
  }
};

using Triangles = std::vector<std::array<Vec3, 3>>;

void add_quad(Triangles& to, Vec3 p, Vec3 q, Vec3 r, Vec3 s) {
  to.push_back({p, q, r});
  to.push_back({p, r, s});
}

/// A square that reaches beyond the body on all sides.
Triangles plane_patch(Model const& m, RigidBody const& plane) {
  Vec3 low = m.mesh.points.front(), high = low;
  for (Vec3 const& p : m.mesh.points)
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  Vec3 const middle = 0.5 * (low + high);
  Vec3 const foot = middle - dot(middle - plane.centre, plane.axis) * plane.axis;
  Frame const f(plane.axis);
  double const reach = 0.75 * norm(high - low);
  Vec3 const a = reach * f.a, b = reach * f.b;
  Triangles t;
  add_quad(t, foot - a - b, foot + a - b, foot + a + b, foot - a + b);
  return t;
}

Triangles sphere_surface(RigidBody const& b) {
  Frame const f({0, 0, 1});
  auto const place = [&](int up, int i) {
    double const latitude = std::numbers::pi * (static_cast<double>(up) / upwards - 0.5);
    return b.centre + b.radius * (std::cos(latitude) * f.circle(i) + std::sin(latitude) * f.c);
  };
  Triangles t;
  for (int up = 0; up < upwards; ++up)
    for (int i = 0; i < around; ++i)
      add_quad(t, place(up, i), place(up, i + 1), place(up + 1, i + 1), place(up + 1, i));
  return t;
}

Triangles cylinder_surface(RigidBody const& b) {
  Frame const f(b.axis);
  Vec3 const low = b.centre - b.half_length * b.axis, high = b.centre + b.half_length * b.axis;
  Triangles t;
  for (int i = 0; i < around; ++i) {
    Vec3 const p = b.radius * f.circle(i), q = b.radius * f.circle(i + 1);
    add_quad(t, low + p, low + q, high + q, high + p);
    t.push_back({low, low + q, low + p});
    t.push_back({high, high + p, high + q});
  }
  return t;
}

Triangles box_surface(RigidBody const& b) {
  Triangles t;
  for (int axis = 0; axis < 3; ++axis)
    for (double const side : {-1.0, 1.0}) {
      Vec3 out, a, c;
      out[axis] = side * b.half[axis];
      a[(axis + 1) % 3] = b.half[(axis + 1) % 3];
      c[(axis + 2) % 3] = side * b.half[(axis + 2) % 3];
      Vec3 const middle = b.centre + out;
      add_quad(t, middle - a - c, middle + a - c, middle + a + c, middle - a + c);
    }
  return t;
}

Triangles surface(Model const& m, RigidBody const& b) {
  switch (b.shape) {
  case RigidBody::Shape::plane:
    return plane_patch(m, b);
  case RigidBody::Shape::sphere:
    return sphere_surface(b);
  case RigidBody::Shape::cylinder:
    return cylinder_surface(b);
  case RigidBody::Shape::box:
    break;
  }
  return box_surface(b);
}

void append(std::vector<float>& to, Vec3 v) {
  for (int r = 0; r < 3; ++r) to.push_back(static_cast<float>(v[r]));
}

} // namespace

Grid rigid_grid(Model const& m, state::State const& s) {
  Grid g;
  std::vector<float> displacement, velocity;
  std::vector<std::int32_t> which, is_impactor;
  for (std::size_t i = 0; i < m.rigid.size(); ++i)
    for (auto const& triangle : surface(m, m.rigid[i])) {
      for (Vec3 const& x : triangle) {
        g.connectivity.push_back(static_cast<std::int64_t>(g.points.size()));
        g.points.push_back(x);
        append(displacement, s.rigid.body[i].u);
        append(velocity, s.rigid.body[i].v);
      }
      g.offsets.push_back(static_cast<std::int64_t>(g.points.size()));
      g.types.push_back(output::cell_type::triangle);
      which.push_back(static_cast<std::int32_t>(i));
      is_impactor.push_back(m.rigid[i].is_impactor);
    }
  g.point_data = {{"displacement", 3, displacement, "m"}, {"velocity", 3, velocity, "m/s"}};
  g.cell_data = {{"body", 1, which, ""}, {"impactor", 1, is_impactor, ""}};
  return g;
}

} // namespace fissura::sim
