#pragma once
// Vectors and 3x3 matrices of doubles: plain values, no expression templates, no allocation.
#include <array>
#include <cmath>

namespace fissura::core {

struct Vec3 {
  double x = 0, y = 0, z = 0;
  constexpr double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr double& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr Vec3& operator+=(Vec3 b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  constexpr Vec3& operator-=(Vec3 b) {
    x -= b.x, y -= b.y, z -= b.z;
    return *this;
  }
  constexpr Vec3& operator*=(double s) {
    x *= s, y *= s, z *= s;
    return *this;
  }
  friend constexpr bool operator==(Vec3 const&, Vec3 const&) = default;
};
constexpr Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(Vec3 a) {
  return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(double s, Vec3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr Vec3 operator*(Vec3 a, double s) {
  return s * a;
}
constexpr Vec3 operator/(Vec3 a, double s) {
  return {a.x / s, a.y / s, a.z / s};
}
constexpr double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) {
  return std::sqrt(dot(a, a));
}
/// Unit vector along a; the zero vector stays zero.
inline Vec3 unit(Vec3 a) {
  double const l = norm(a);
  return l > 0 ? a / l : Vec3{};
}

/// Row-major 3x3 matrix: m[i] is row i.
struct Mat3 {
  std::array<Vec3, 3> row{};
  constexpr Vec3 const& operator[](int i) const { return row[i]; }
  constexpr Vec3& operator[](int i) { return row[i]; }
  static constexpr Mat3 identity() { return {{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}}; }
  static constexpr Mat3 from_columns(Vec3 a, Vec3 b, Vec3 c) {
    return {{Vec3{a.x, b.x, c.x}, Vec3{a.y, b.y, c.y}, Vec3{a.z, b.z, c.z}}};
  }
};
constexpr Vec3 operator*(Mat3 const& m, Vec3 v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
constexpr Mat3 transpose(Mat3 const& m) {
  return Mat3::from_columns(m[0], m[1], m[2]);
}
constexpr Mat3 operator*(Mat3 const& a, Mat3 const& b) {
  Mat3 const t = transpose(b);
  Mat3 r;
  for (int i = 0; i < 3; ++i) r[i] = {dot(a[i], t[0]), dot(a[i], t[1]), dot(a[i], t[2])};
  return r;
}
constexpr Mat3 operator+(Mat3 const& a, Mat3 const& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}
constexpr Mat3 operator-(Mat3 const& a, Mat3 const& b) {
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}
constexpr Mat3 operator*(double s, Mat3 const& a) {
  return {{s * a[0], s * a[1], s * a[2]}};
}
constexpr double trace(Mat3 const& m) {
  return m[0].x + m[1].y + m[2].z;
}
constexpr double determinant(Mat3 const& m) {
  return dot(m[0], cross(m[1], m[2]));
}
/// Double contraction a : b.
constexpr double contract(Mat3 const& a, Mat3 const& b) {
  return dot(a[0], b[0]) + dot(a[1], b[1]) + dot(a[2], b[2]);
}
/// Cofactor matrix: inverse(m) = transpose(cofactor(m)) / determinant(m).
constexpr Mat3 cofactor(Mat3 const& m) {
  return {{cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])}};
}
constexpr Mat3 inverse(Mat3 const& m) {
  return (1 / determinant(m)) * transpose(cofactor(m));
}

} // namespace fissura::core

namespace fissura {
using core::Mat3;
using core::Vec3;
} // namespace fissura
