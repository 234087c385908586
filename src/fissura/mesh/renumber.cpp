#include "fissura/mesh/renumber.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/merge.hpp"

namespace fissura::mesh {

namespace {

/// Rotations of the three bits of an octant number.
unsigned rotate_left(unsigned b, unsigned n) {
  return ((b << n) | (b >> (3 - n))) & 7u;
}
unsigned rotate_right(unsigned b, unsigned n) {
  return ((b >> n) | (b << (3 - n))) & 7u;
}
unsigned gray(unsigned i) {
  return i ^ (i >> 1);
}
unsigned gray_rank(unsigned g) {
  return (g ^ (g >> 1) ^ (g >> 2)) & 7u;
}
/// The corner at which the curve enters its i-th octant, and the axis along which it leaves it.
unsigned entry(unsigned i) {
  return i == 0 ? 0 : gray(2 * ((i - 1) / 2));
}
unsigned direction(unsigned i) {
  if (i == 0) return 0;
  return static_cast<unsigned>(std::countr_one(i % 2 == 0 ? i - 1 : i)) % 3;
}

/// Gives every point its new number; -1 drops it.
void move_points(Mesh& mesh, std::vector<int> const& number, int count) {
  std::vector<Vec3> points(count);
  for (std::size_t p = 0; p < number.size(); ++p)
    if (number[p] >= 0) points[number[p]] = mesh.points[p];
  mesh.points = std::move(points);
  auto const follow = [&](auto& item) {
    for (int& p : item) p = number[p];
  };
  for (auto& t : mesh.tets) follow(t);
  for (auto& g : mesh.face_groups)
    for (auto& t : g.triangles) follow(t);
  for (auto& g : mesh.line_groups)
    for (auto& s : g.segments) follow(s);
  for (auto& g : mesh.point_groups) follow(g.points);
}

/// Calls visit(point) for the points of all groups.
template <class Visit> void visit_group_points(Mesh const& mesh, Visit visit) {
  for (auto const& g : mesh.face_groups)
    for (auto const& t : g.triangles) std::for_each(t.begin(), t.end(), visit);
  for (auto const& g : mesh.line_groups)
    for (auto const& s : g.segments) std::for_each(s.begin(), s.end(), visit);
  for (auto const& g : mesh.point_groups) std::for_each(g.points.begin(), g.points.end(), visit);
}

std::vector<int> order_along_curve(Mesh const& mesh) {
  Vec3 low = mesh.points[mesh.tets[0][0]];
  for (Vec3 const& p : mesh.points)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]);
  double const extent = largest_extent(mesh.points);
  double const scale = extent > 0 ? 0x1p20 / extent : 0;
  static_assert(hilbert_bits == 20);
  std::vector<std::pair<std::uint64_t, int>> keys;
  keys.reserve(mesh.tets.size());
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    Vec3 const c = geometry::centroid(corners(mesh, t));
    std::array<std::uint32_t, 3> cell{};
    for (int k = 0; k < 3; ++k)
      cell[k] = static_cast<std::uint32_t>(std::clamp(std::floor((c[k] - low[k]) * scale), 0.0, 0x1p20 - 1));
    keys.emplace_back(hilbert_index(cell), t);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<int> order;
  order.reserve(keys.size());
  for (auto const& k : keys) order.push_back(k.second);
  return order;
}

template <class T> void reorder(std::vector<T>& values, std::vector<int> const& order) {
  std::vector<T> moved;
  moved.reserve(order.size());
  for (int i : order) moved.push_back(values[i]);
  values = std::move(moved);
}

/// order[k] is the former number of tet k.
void follow_tets(std::vector<TetSet>& sets, std::vector<int> const& order) {
  if (sets.empty()) return;
  std::vector<int> now(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    now[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  for (auto& set : sets) {
    for (int& t : set.tets) t = now[static_cast<std::size_t>(t)];
    std::sort(set.tets.begin(), set.tets.end());
  }
}

} // namespace

std::uint64_t hilbert_index(std::array<std::uint32_t, 3> cell, int bits) {
  // At each level the curve in the present cube is the standard one, turned so that it enters at corner
  // `from` and leaves along axis `axis`.
  std::uint64_t index = 0;
  unsigned from = 0, axis = 0;
  for (int level = bits - 1; level >= 0; --level) {
    unsigned octant = 0;
    for (int k = 0; k < 3; ++k) octant |= ((cell[k] >> level) & 1u) << k;
    unsigned const rank = gray_rank(rotate_right(octant ^ from, (axis + 1) % 3));
    index = (index << 3) | rank;
    from ^= rotate_left(entry(rank), (axis + 1) % 3);
    axis = (axis + direction(rank) + 1) % 3;
  }
  return index;
}

void renumber(Mesh& mesh) {
  if (mesh.tets.empty()) return;
  if (mesh.input_id.empty()) {
    mesh.input_id.resize(mesh.tets.size());
    std::iota(mesh.input_id.begin(), mesh.input_id.end(), 0);
  }
  auto const order = order_along_curve(mesh);
  reorder(mesh.tets, order);
  reorder(mesh.tet_group, order);
  if (!mesh.tet_body.empty()) reorder(mesh.tet_body, order);
  reorder(mesh.input_id, order);
  follow_tets(mesh.tet_sets, order);
  std::vector<int> number(mesh.points.size(), -1);
  int count = 0;
  auto const use = [&](int p) {
    if (number[p] < 0) number[p] = count++;
  };
  for (auto const& t : mesh.tets) std::for_each(t.begin(), t.end(), use);
  visit_group_points(mesh, use);
  move_points(mesh, number, count);
}

void drop_unused_points(Mesh& mesh) {
  std::vector<int> number(mesh.points.size(), -1);
  auto const use = [&](int p) { number[p] = 0; };
  for (auto const& t : mesh.tets) std::for_each(t.begin(), t.end(), use);
  visit_group_points(mesh, use);
  int count = 0;
  for (int& n : number)
    if (n == 0) n = count++;
  move_points(mesh, number, count);
}

} // namespace fissura::mesh
