#include "fissura/contact/polyhedron.hpp"

namespace fissura::contact {

namespace {

int slot_of(std::array<std::int8_t, 3> const& next, int neighbour) {
  return next[0] == neighbour ? 0 : next[1] == neighbour ? 1 : 2;
}

} // namespace

Polyhedron::Polyhedron(std::array<Vec3, 4> const& corners) : count_(4) {
  for (int i = 0; i < 4; ++i) corner_[i] = corners[i];
  next_[0] = {2, 3, 1};
  next_[1] = {0, 3, 2};
  next_[2] = {1, 3, 0};
  next_[3] = {0, 2, 1};
}

void Polyhedron::keep_positive(std::array<double, capacity> const& value) {
  int const old = count_;
  int outside = 0;
  for (int i = 0; i < old; ++i) outside += value[i] < 0;
  if (outside == 0) return;
  if (outside == old) {
    count_ = 0;
    return;
  }
  for (int v = 0; v < old; ++v) {
    if (value[v] < 0) continue;
    for (auto& w : next_[v]) {
      if (w >= old || !(value[w] < 0)) continue;
      double const share = value[v] / (value[v] - value[w]);
      corner_[count_] = corner_[v] + share * (corner_[w] - corner_[v]);
      next_[count_] = {static_cast<std::int8_t>(v), -1, -1};
      w = static_cast<std::int8_t>(count_++);
    }
  }
  close_cut(old);
  drop_outside(value, old);
}

/// Joins the new corners by the edges of the cut: around each face that was cut, from the corner where it is
/// entered to the one where it is left.
void Polyhedron::close_cut(int first_new) {
  for (int start = first_new; start < count_; ++start) {
    int from = start, at = next_[start][0];
    while (at < first_new) {
      int const on = next_[at][(slot_of(next_[at], from) + 1) % 3];
      from = at, at = on;
    }
    next_[start][2] = static_cast<std::int8_t>(at);
    next_[at][1] = static_cast<std::int8_t>(start);
  }
}

void Polyhedron::drop_outside(std::array<double, capacity> const& value, int first_new) {
  std::array<std::int8_t, capacity> now{};
  int kept = 0;
  for (int i = 0; i < count_; ++i) {
    if (i < first_new && value[i] < 0) continue;
    corner_[kept] = corner_[i];
    next_[kept] = next_[i];
    now[i] = static_cast<std::int8_t>(kept++);
  }
  count_ = kept;
  for (int i = 0; i < count_; ++i)
    for (auto& n : next_[i]) n = now[n];
}

Solid Polyhedron::solid() const {
  Solid s;
  if (count_ == 0) return s;
  Vec3 const origin = corner_[0];
  Vec3 moment;
  std::array<std::uint8_t, capacity> seen{};
  for (int v = 0; v < count_; ++v)
    for (int k = 0; k < 3; ++k) {
      if (seen[v] & (1 << k)) continue;
      // Around one face, cut into triangles that share its first corner.
      seen[v] |= static_cast<std::uint8_t>(1 << k);
      Vec3 const a = corner_[v] - origin;
      int from = v, at = next_[v][k];
      Vec3 b = corner_[at] - origin;
      for (;;) {
        int const turn = (slot_of(next_[at], from) + 1) % 3;
        seen[at] |= static_cast<std::uint8_t>(1 << turn);
        from = at, at = next_[at][turn];
        if (at == v) break;
        Vec3 const c = corner_[at] - origin;
        double const part = dot(a, cross(b, c));
        s.volume += part;
        moment += part * (a + b + c);
        b = c;
      }
    }
  if (s.volume != 0) s.centroid = origin + moment / (4 * s.volume);
  s.volume /= 6;
  return s;
}

} // namespace fissura::contact
