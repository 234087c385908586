#include "fissura/contact/tet_overlap.hpp"

#include <algorithm>

#include "fissura/contact/polyhedron.hpp"
#include "fissura/mesh/mesh.hpp"

namespace fissura::contact {

namespace {

using Values = std::array<double, Polyhedron::capacity>;

/// Outward area vectors (twice the area) of the faces opposite to each corner.
std::array<Vec3, 4> area_vectors(std::array<Vec3, 4> const& x) {
  Vec3 const a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  Vec3 const f1 = cross(c, b), f2 = cross(a, c), f3 = cross(b, a);
  return {-(f1 + f2 + f3), f1, f2, f3};
}

double six_volumes(std::array<Vec3, 4> const& x) {
  return dot(x[1] - x[0], cross(x[2] - x[0], x[3] - x[0]));
}

bool all_outside(std::array<Vec3, 4> const& t, int face, std::array<Vec3, 4> const& points) {
  auto const& c = mesh::face_corners[face];
  Vec3 const p = t[c[0]], outward = cross(t[c[1]] - p, t[c[2]] - p);
  return dot(outward, points[0] - p) >= 0 && dot(outward, points[1] - p) >= 0 &&
         dot(outward, points[2] - p) >= 0 && dot(outward, points[3] - p) >= 0;
}

Polyhedron common_part(TetNow const& a, TetNow const& b) {
  Polyhedron p(b.x);
  Values value;
  for (int f = 0; f < 4 && !p.empty(); ++f) {
    for (int i = 0; i < p.count(); ++i) value[i] = a.lambda(f, p[i]);
    p.keep_positive(value);
  }
  return p;
}

/// The part of a common volume over which one face of `owner` is the nearest.
struct Share {
  int face;
  Solid solid;
};
struct Shares {
  std::array<Share, 4> share;
  int count = 0;
};

Shares split_by_nearest_face(Polyhedron const& p, Solid const& whole, TetNow const& owner) {
  std::array<Values, 4> depth;
  for (int f = 0; f < 4; ++f)
    for (int i = 0; i < p.count(); ++i) depth[f][i] = owner.altitude[f] * owner.lambda(f, p[i]);
  auto is_nearest_everywhere = [&](int f) {
    for (int i = 0; i < p.count(); ++i)
      for (int g = 0; g < 4; ++g)
        if (depth[g][i] < depth[f][i]) return false;
    return true;
  };
  Shares shares;
  for (int f = 0; f < 4; ++f)
    if (is_nearest_everywhere(f)) {
      shares.share[shares.count++] = {f, whole};
      return shares;
    }
  for (int f = 0; f < 4; ++f) {
    Polyhedron part = p;
    Values value;
    for (int g = 0; g < 4 && !part.empty(); ++g) {
      if (g == f) continue;
      for (int i = 0; i < part.count(); ++i)
        value[i] =
            owner.altitude[g] * owner.lambda(g, part[i]) - owner.altitude[f] * owner.lambda(f, part[i]);
      part.keep_positive(value);
    }
    if (part.empty()) continue;
    Solid const solid = part.solid();
    if (solid.volume > 0) shares.share[shares.count++] = {f, solid};
  }
  return shares;
}

/// Adds what the potential of `owner` does to `other` inside it; `sense` is +1 where `other` is b.
void press_out(Shares const& shares, TetNow const& owner, TetNow const& other, double sense, TetOverlap& sum,
               std::array<Vec3, 4>& on_owner, std::array<Vec3, 4>& on_other) {
  for (int i = 0; i < shares.count; ++i) {
    auto const& [face, solid] = shares.share[i];
    double const measure = solid.volume / other.volume_ratio;
    Vec3 const force = -(owner.altitude[face] * measure) * owner.gradient[face];
    sum.energy += owner.altitude[face] * owner.lambda(face, solid.centroid) * measure;
    sum.force += sense * force;
    for (int c = 0; c < 4; ++c) {
      on_other[c] += other.lambda(c, solid.centroid) * force;
      on_owner[c] -= owner.lambda(c, solid.centroid) * force;
    }
  }
}

constexpr std::array<std::array<int, 2>, 6> edge_corners{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// What lies between the shadows of two tets on a line [m]; negative or 0 where they meet. An axis of no
/// length, of parallel edges, tells nothing.
double gap_along(Vec3 axis, std::array<Vec3, 4> const& a, std::array<Vec3, 4> const& b) {
  double const length = norm(axis);
  if (!(length > 0)) return 0;
  auto shadow = [axis](std::array<Vec3, 4> const& t, Vec3 origin) {
    double const x[4] = {dot(axis, t[0] - origin), dot(axis, t[1] - origin), dot(axis, t[2] - origin),
                         dot(axis, t[3] - origin)};
    return std::minmax({x[0], x[1], x[2], x[3]});
  };
  auto const [low_a, high_a] = shadow(a, a[0]);
  auto const [low_b, high_b] = shadow(b, a[0]);
  return std::max(low_b - high_a, low_a - high_b) / length;
}

} // namespace

TetNow make_tet_now(std::array<Vec3, 4> const& now, std::array<Vec3, 4> const& reference) {
  TetNow t;
  t.x = now;
  double const volume = six_volumes(now), before = six_volumes(reference);
  t.volume_ratio = volume / before;
  auto const area = area_vectors(now), area_before = area_vectors(reference);
  for (int c = 0; c < 4; ++c) {
    if (volume > 0) t.gradient[c] = (-1 / volume) * area[c];
    t.altitude[c] = before / norm(area_before[c]);
  }
  return t;
}

bool are_apart(std::array<Vec3, 4> const& a, std::array<Vec3, 4> const& b, std::uint8_t& separator) {
  auto separates = [&](int f) { return f < 4 ? all_outside(a, f, b) : all_outside(b, f - 4, a); };
  if (separates(separator)) return true;
  for (int f = 0; f < 8; ++f)
    if (separates(f)) {
      separator = static_cast<std::uint8_t>(f);
      return true;
    }
  return false;
}

double gap_between(std::array<Vec3, 4> const& a, std::array<Vec3, 4> const& b) {
  double widest = 0;
  for (auto const& f : mesh::face_corners) {
    widest = std::max(widest, gap_along(cross(a[f[1]] - a[f[0]], a[f[2]] - a[f[0]]), a, b));
    widest = std::max(widest, gap_along(cross(b[f[1]] - b[f[0]], b[f[2]] - b[f[0]]), a, b));
  }
  for (auto const& e : edge_corners)
    for (auto const& f : edge_corners)
      widest = std::max(widest, gap_along(cross(a[e[1]] - a[e[0]], b[f[1]] - b[f[0]]), a, b));
  return widest;
}

TetOverlap overlap(TetNow const& a, TetNow const& b) {
  TetOverlap sum;
  Polyhedron const common = common_part(a, b);
  if (common.empty()) return sum;
  Solid const whole = common.solid();
  if (!(whole.volume > 0)) return sum;
  sum.volume = whole.volume;
  sum.centroid = whole.centroid;
  press_out(split_by_nearest_face(common, whole, a), a, b, 1, sum, sum.on_a, sum.on_b);
  press_out(split_by_nearest_face(common, whole, b), b, a, -1, sum, sum.on_b, sum.on_a);
  return sum;
}

} // namespace fissura::contact
