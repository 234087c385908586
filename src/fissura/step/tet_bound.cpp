#include "fissura/step/tet_bound.hpp"

#include <algorithm>
#include <cmath>

namespace fissura::step {

namespace {

using Mat6 = std::array<std::array<double, 6>, 6>;

/// Bound of the largest eigenvalue of a positive semidefinite matrix: tr(A^32)^(1/32), at most 6^(1/32) times
/// it.
double eigenvalue_bound(Mat6 a) {
  double scale = 0;
  for (std::size_t i = 0; i < 6; ++i) scale += a[i][i];
  if (!(scale > 0)) return 0;
  for (auto& row : a)
    for (double& x : row) x /= scale;
  for (int squaring = 0; squaring < 5; ++squaring) {
    Mat6 s{};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        for (std::size_t k = 0; k < 6; ++k) s[i][j] += a[i][k] * a[k][j];
    a = s;
  }
  double trace = 0;
  for (std::size_t i = 0; i < 6; ++i) trace += a[i][i];
  return scale * std::pow(trace, 1.0 / 32);
}

/// Largest eigenvalue of a symmetric 3x3 matrix, closed form.
double largest_eigenvalue(Mat3 const& a) {
  double const q = trace(a) / 3;
  Mat3 const d = a - q * Mat3::identity();
  double const p = std::sqrt(contract(d, d) / 6);
  if (p <= 0) return q;
  double const r = std::clamp(0.5 * determinant((1 / p) * d), -1.0, 1.0);
  return q + 2 * p * std::cos(std::acos(r) / 3);
}

} // namespace

std::array<Vec3, 4> shape_gradients(model::Model const& m, std::size_t tet) {
  std::array<Vec3, 4> g;
  for (int a = 0; a < 3; ++a) {
    for (int r = 0; r < 3; ++r) g[a + 1][r] = m.tets.gradient[model::at(tet, 3 * a + r, 9)];
    g[0] -= g[a + 1];
  }
  return g;
}

double elastic_bound(model::Model const& m, std::size_t tet, std::array<double, 4> const& mass) {
  double const G = m.tets.shear_modulus(tet), lambda = m.tets.lame(tet), volume = m.tets.volume[tet];
  double const root = std::sqrt(2 * G),
               bulk = (std::sqrt(2 * G + 3 * lambda) - root) / 3; // D^1/2 of an isotropic body
  auto const gradient = shape_gradients(m, tet);
  Mat6 a{};
  for (std::size_t n = 0; n < 4; ++n) {
    Vec3 const g = gradient[n];
    // strains xx yy zz xy yz zx of a unit displacement along x, y, z
    double const strain[3][6] = {
        {g.x, 0, 0, g.y, 0, g.z}, {0, g.y, 0, g.x, g.z, 0}, {0, 0, g.z, 0, g.y, g.x}};
    for (auto const& e : strain) {
      double const mean = bulk * (e[0] + e[1] + e[2]);
      double c[6];
      for (int i = 0; i < 6; ++i) c[i] = i < 3 ? root * e[i] + mean : std::sqrt(G) * e[i];
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) a[i][j] += volume / mass[n] * c[i] * c[j];
    }
  }
  return eigenvalue_bound(a);
}

double viscous_bound(model::Model const& m, std::size_t tet, std::array<double, 4> const& mass) {
  auto const g = shape_gradients(m, tet);
  Mat3 sum;
  for (std::size_t n = 0; n < 4; ++n)
    sum = sum + (1 / mass[n]) * Mat3{{g[n].x * g[n], g[n].y * g[n], g[n].z * g[n]}};
  return m.tets.volume[tet] * m.tets.viscosity(tet) * largest_eigenvalue(sum);
}

} // namespace fissura::step
