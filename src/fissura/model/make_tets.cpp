#include <algorithm>
#include <array>
#include <numeric>

#include "fissura/model/elasticity.hpp"
#include "fissura/model/make_blocks.hpp"
#include "fissura/model/make_joints.hpp"

namespace fissura::model {

namespace {

/// Padding lanes: identity edges, no volume, no mass.
void make_tet_data(Model& m) {
  auto& t = m.tets;
  check_tet_count(m.mesh.tets.size());
  t.count = static_cast<int>(m.mesh.tets.size());
  std::size_t const n = t.blocks() * block;
  t.gradient = core::Buffer<double>(9 * n);
  t.volume = core::Buffer<double>(n);
  t.inverse_mass = core::Buffer<double>(4 * n);
  t.weight_ratio = core::Buffer<double>(n);
  t.is_paper.assign(n, 0);
  m.position = core::NodeField(4 * n);
  m.mass = core::Buffer<double>(4 * n);
  m.steel_mass = core::Buffer<double>(4 * n);
  for (std::size_t i = 0; i < n; ++i) t.weight_ratio[i] = 1;

  for (std::size_t i = 0; i < static_cast<std::size_t>(t.count); ++i) {
    auto const& c = m.source.concretes[m.material_of_tet[i]];
    auto const x = mesh::corners(m.mesh, static_cast<int>(i));
    Mat3 const edges = Mat3::from_columns(x[1] - x[0], x[2] - x[0], x[3] - x[0]);
    Mat3 const gradient = inverse(edges);
    t.volume[i] = determinant(edges) / 6;
    for (int a = 0; a < 3; ++a)
      for (int r = 0; r < 3; ++r) t.gradient[at(i, 3 * a + r, 9)] = gradient[a][r];
    t.any_viscosity |= c.mu_bar > 0;
    t.weight_ratio[i] = 1 / c.density_factor;
    t.any_scaled |= c.density_factor != 1;
    t.is_paper[i] = c.tet_law == TetLaw::paper;
    double const mass = c.density * t.volume[i];
    m.total_mass += mass;
    m.added_mass += mass * (c.density_factor - 1);
    for (std::size_t a = 0; a < 4; ++a) {
      m.mass[4 * i + a] = mass * c.density_factor / 4;
      for (int r = 0; r < 3; ++r) m.position(4 * i + a, r) = x[a][r];
    }
  }
}

/// G, lambda and viscosity, once the joints are known.
void make_moduli(Model& m) {
  auto& t = m.tets;
  auto const compliance = joint_compliance(m);
  auto const last = static_cast<std::size_t>(t.count - 1); // padding is of the last tet's concrete
  t.moduli = SharedRows<3, block>(t.blocks() * block, [&](std::size_t i) -> std::array<double, 3> {
    std::size_t const tet = std::min(i, last);
    auto const& c = m.source.concretes[static_cast<std::size_t>(m.material_of_tet[tet])];
    auto const e = compensated(c, compliance[tet]);
    return {e.G(), e.lame(), c.mu_bar};
  });
}

int find_root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Nodes joined across faces without a joint form clusters; the smallest node of a cluster is its root.
void make_bonding(Model& m) {
  std::vector<int> parent(4 * static_cast<std::size_t>(m.tets.count));
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t f = 0; f < m.adjacency.shared.size(); ++f) {
    if (m.joint_of_shared_face[f] >= 0) continue;
    m.bonding.any = true;
    auto const& face = m.adjacency.shared[f];
    for (int k = 0; k < 3; ++k) {
      int const a = find_root(parent, node_of(face.a.tet, face.corner_a[k]));
      int const b = find_root(parent, node_of(face.b.tet, face.corner_b[k]));
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  if (!m.bonding.any) return;
  std::vector<std::vector<int>> members(parent.size());
  for (std::size_t i = 0; i < parent.size(); ++i)
    members[find_root(parent, static_cast<int>(i))].push_back(static_cast<int>(i));
  m.bonding.start.push_back(0);
  for (auto const& cluster : members) {
    if (cluster.empty()) continue;
    m.bonding.node.insert(m.bonding.node.end(), cluster.begin(), cluster.end());
    m.bonding.start.push_back(static_cast<int>(m.bonding.node.size()));
  }
}

void renew_inverse_masses(Model& m) {
  auto set = [&](int node, double mass) {
    m.tets.inverse_mass[at(static_cast<std::size_t>(node / 4), node % 4, 4)] = 1 / mass;
  };
  if (!m.bonding.any) {
    for (int node = 0; node < 4 * m.tets.count; ++node) set(node, m.mass[node]);
    return;
  }
  for (std::size_t c = 0; c + 1 < m.bonding.start.size(); ++c) {
    double sum = 0;
    for (int i = m.bonding.start[c]; i < m.bonding.start[c + 1]; ++i) sum += m.mass[m.bonding.node[i]];
    for (int i = m.bonding.start[c]; i < m.bonding.start[c + 1]; ++i) set(m.bonding.node[i], sum);
  }
}

} // namespace

void check_tet_count(std::size_t tets) {
  if (tets >= (std::size_t{1} << 27U))
    throw core::Error(core::Failure::input, "more than 134 million tets: the node numbers would overflow");
}

void make_blocks(Model& m) {
  make_tet_data(m);
  make_joints(m);
  make_moduli(m);
  make_bonding(m);
  renew_inverse_masses(m);
}

void scale_masses(Model& m, std::span<double const> factor) {
  for (std::size_t t = 0; t < factor.size(); ++t) {
    if (factor[t] == 1) continue;
    for (std::size_t a = 0; a < 4; ++a) {
      m.added_mass += (factor[t] - 1) * m.mass[4 * t + a];
      m.mass[4 * t + a] *= factor[t];
    }
    m.tets.weight_ratio[t] /= factor[t];
    m.tets.any_scaled = true;
  }
  renew_inverse_masses(m);
}

void add_steel_mass(Model& m, std::span<double const> steel_mass) {
  for (std::size_t i = 0; i < steel_mass.size(); ++i) {
    double const factor = 1 / m.tets.weight_ratio[i / 4];
    m.steel_mass[i] = steel_mass[i];
    m.mass[i] += steel_mass[i] * factor;
    m.total_mass += steel_mass[i];
    m.added_mass += steel_mass[i] * (factor - 1);
  }
  renew_inverse_masses(m);
}

} // namespace fissura::model
