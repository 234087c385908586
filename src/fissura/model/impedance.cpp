#include "fissura/model/impedance.hpp"

#include <cmath>
#include <utility>

#include "fissura/model/elasticity.hpp"

namespace fissura::model {

namespace {

constexpr std::array<std::pair<int, int>, 6> places{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

Mat3 tensor_of(Six const& s) {
  Mat3 t;
  for (std::size_t i = 0; i < 6; ++i) {
    auto const [r, c] = places[i];
    t[r][c] = t[c][r] = r == c ? s[i] : s[i] / std::sqrt(2.0);
  }
  return t;
}
Six six_of(Mat3 const& t) {
  Six s;
  for (std::size_t i = 0; i < 6; ++i) {
    auto const [r, c] = places[i];
    s[i] = r == c ? t[r][c] : std::sqrt(0.5) * (t[r][c] + t[c][r]);
  }
  return s;
}

/// Gauss-Jordan without pivoting: the matrix is symmetric and positive.
SixBySix inverse_of(SixBySix a) {
  for (std::size_t k = 0; k < 6; ++k) {
    double const pivot = 1 / a[k][k];
    a[k][k] = 1;
    for (double& x : a[k]) x *= pivot;
    for (std::size_t i = 0; i < 6; ++i) {
      if (i == k) continue;
      double const factor = std::exchange(a[i][k], 0);
      for (std::size_t j = 0; j < 6; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  return a;
}

/// sum (A/k) n n^T over the joints of a concrete, per volume [1/Pa]; each side has half of a joint.
Mat3 joint_fabric(Model const& m, int concrete) {
  Mat3 fabric;
  double volume = 0;
  for (std::size_t t = 0; t < m.material_of_tet.size(); ++t)
    if (m.material_of_tet[t] == concrete) volume += m.tets.volume[t];
  for (int i = 0; i < m.joints.count; ++i) {
    auto const& joint = m.joints.joints[i];
    auto const& face = m.adjacency.shared[joint.shared_face];
    int const sides = (m.material_of_tet[face.a.tet] == concrete ? 1 : 0) +
                      (m.material_of_tet[face.b.tet] == concrete ? 1 : 0);
    if (sides == 0) continue;
    auto edge = [&](int e) {
      auto const j = static_cast<std::size_t>(i);
      return Vec3{m.joints.edge[at(j, e, 6)], m.joints.edge[at(j, e + 1, 6)], m.joints.edge[at(j, e + 2, 6)]};
    };
    Vec3 const n = unit(cross(edge(0), edge(3)));
    double const share = 0.5 * sides * joint.area / m.joints.k(static_cast<std::size_t>(i)) / volume;
    for (int r = 0; r < 3; ++r) fabric[r] += share * n[r] * n;
  }
  return fabric;
}

} // namespace

SixBySix jointed_stiffness(Model const& m, int concrete) {
  auto const& c = m.source.concretes[static_cast<std::size_t>(concrete)];
  Mat3 const B = joint_fabric(m, concrete);
  auto const e = compensated(c, c.elastic == Elasticity::compensated ? trace(B) / 3 : 0);
  SixBySix compliance;
  for (std::size_t i = 0; i < 6; ++i) {
    Six stress{};
    stress[i] = 1;
    Mat3 const sigma = tensor_of(stress), opened = 0.5 * (sigma * B + B * sigma);
    compliance[i] =
        six_of(((1 + e.nu) / e.E) * sigma - (e.nu / e.E * trace(sigma)) * Mat3::identity() + opened);
  }
  return inverse_of(compliance);
}

Mat3 acoustic_tensor(SixBySix const& stiffness, Vec3 n) {
  Mat3 acoustic;
  for (int r = 0; r < 3; ++r) {
    Vec3 e;
    e[r] = 1;
    Mat3 direction; // e n^T
    for (int i = 0; i < 3; ++i) direction[i] = e[i] * n;
    Six const strain = six_of(direction);
    Six stress{};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) stress[i] += stiffness[i][j] * strain[j];
    acoustic[r] = tensor_of(stress) * n;
  }
  return acoustic;
}

Mat3 impedance(Mat3 const& acoustic, double density) {
  // Newton's iteration for the root, with its inverse beside it (Denman and Beavers); converges from any
  // positive matrix, fast once the matrix is scaled to a trace of 3.
  double const scale = trace(acoustic) / 3;
  Mat3 root = (1 / scale) * acoustic, other = Mat3::identity();
  for (int i = 0; i < 30; ++i) {
    Mat3 const next = 0.5 * (root + inverse(other));
    other = 0.5 * (other + inverse(root));
    root = next;
  }
  return std::sqrt(density * scale) * root;
}

} // namespace fissura::model
