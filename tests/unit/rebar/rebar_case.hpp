#pragma once
// What the tests of this folder share: a mesh with all faces jointed, a steel, and bars in it.
#include <numeric>
#include <vector>

#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/mesh.hpp"
#include "fissura/rebar/embed.hpp"
#include "support/random_mesh.hpp"

namespace fissura::test {

inline mesh::Mesh kuhn_box(std::array<int, 3> cells, Vec3 size) {
  mesh::BoxCells box;
  box.to = size;
  box.cells = cells;
  return mesh::make_boxes({&box, 1});
}

inline model::SteelSpec table_4_steel() {
  model::SteelSpec s;
  s.name = "steel";
  s.E_s = 210e9, s.f_y = 530e6, s.f_u = 650e6, s.eps_sh = 0.03, s.eps_u = 0.1, s.eps_br = 0.12;
  return s;
}

inline model::BarSpec bar_along(std::vector<Vec3> points, double diameter = 0.02) {
  model::BarSpec b;
  b.place = {"case.toml", 7, 1};
  b.name = "bar";
  b.steel = "steel";
  b.diameter = diameter;
  b.points = std::move(points);
  return b;
}

struct Embedded {
  mesh::Mesh mesh;
  mesh::Adjacency adjacency;
  std::vector<int> joint_of_shared_face;
  rebar::Embedding embedding;

  model::Bars const& bars() const { return embedding.bars; }
  Vec3 start_of(model::BarElement const& e) const { return geometry::at(corners(mesh, e.tet), e.w0); }
  Vec3 end_of(model::BarElement const& e) const { return geometry::at(corners(mesh, e.tet), e.w1); }
};

/// Every shared face has a joint of the same number.
inline Embedded embed(mesh::Mesh mesh, std::vector<model::BarSpec> const& bars) {
  Embedded e;
  e.mesh = std::move(mesh);
  e.adjacency = make_adjacency(e.mesh);
  e.joint_of_shared_face.resize(e.adjacency.shared.size());
  std::iota(e.joint_of_shared_face.begin(), e.joint_of_shared_face.end(), 0);
  std::vector<model::SteelSpec> const steels{table_4_steel()};
  e.embedding = rebar::embed_bars(e.mesh, e.adjacency, bars, steels, e.joint_of_shared_face);
  return e;
}

} // namespace fissura::test
