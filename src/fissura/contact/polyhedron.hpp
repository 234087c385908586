#pragma once
// Convex polyhedra for the common part of two tets: every corner has exactly three neighbours, also where it
// lies on a plane that cut it, so no cut needs a special case.
#include <array>
#include <cstdint>

#include "fissura/core/vec3.hpp"

namespace fissura::contact {

/// Volume [m3] and centroid [m].
struct Solid {
  double volume = 0;
  Vec3 centroid;
};

class Polyhedron {
 public:
  /// At most 4 + 4 + 3 planes bound what is made here: 18 corners, and a cut adds fewer than it meets
  /// edges, 27.
  static constexpr int capacity = 64;

  /// A tet of positive volume.
  explicit Polyhedron(std::array<Vec3, 4> const& corners);

  bool empty() const { return count_ == 0; }
  int count() const { return count_; }
  Vec3 operator[](int i) const { return corner_[i]; }

  /// Keeps the part where value[i], given at the corners and linear in between, is not negative.
  void keep_positive(std::array<double, capacity> const& value);

  Solid solid() const;

 private:
  using Neighbours = std::array<std::int8_t, 3>;
  void close_cut(int first_new);
  void drop_outside(std::array<double, capacity> const& value, int first_new);

  int count_ = 0;
  std::array<Vec3, capacity> corner_;
  std::array<Neighbours, capacity> next_; ///< in a fixed sense of rotation, seen from outside
};

} // namespace fissura::contact
