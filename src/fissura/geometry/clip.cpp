#include "fissura/geometry/clip.hpp"

#include <algorithm>

namespace fissura::geometry {

using core::dot;
using core::norm;

std::optional<TetPassage> clip_to_tet(Tet const& t, Vec3 a, Vec3 b) {
  // Inside means all four barycentric coordinates >= 0, and each of them is linear along the segment.
  auto const la = barycentric(t, a), lb = barycentric(t, b);
  TetPassage part;
  for (int f = 0; f < 4; ++f) {
    if (la[f] < 0 && lb[f] < 0) return std::nullopt;
    if (la[f] >= 0 && lb[f] >= 0) continue;
    double const s = la[f] / (la[f] - lb[f]);
    if (la[f] < 0 && s >= part.begin) part.begin = s, part.enter_face = f;
    if (lb[f] < 0 && s <= part.end) part.end = s, part.exit_face = f;
  }
  if (part.begin > part.end) return std::nullopt;
  return part;
}

std::optional<TriangleCrossing> cross_triangle(Triangle const& t, Vec3 a, Vec3 b) {
  Vec3 const n = normal(t);
  double const da = dot(a - t[0], n), db = dot(b - t[0], n);
  if (da == db || (da > 0 && db > 0) || (da < 0 && db < 0)) return std::nullopt;
  double const s = da / (da - db);
  auto const l = barycentric(t, a + s * (b - a));
  if (l[0] < 0 || l[1] < 0 || l[2] < 0) return std::nullopt;
  return TriangleCrossing{s, l};
}

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  double const length2 = dot(b - a, b - a);
  double const s = length2 > 0 ? std::clamp(dot(p - a, b - a) / length2, 0.0, 1.0) : 0.0;
  return norm(p - (a + s * (b - a)));
}

} // namespace fissura::geometry
