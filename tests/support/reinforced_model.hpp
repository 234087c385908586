#pragma once
// Models with bars straight from a mesh, for tests of `step` (which knows no deck and no driver).
#include <set>

#include "fissura/rebar/rebar.hpp"
#include "fissura/step/advance.hpp"
#include "support/concrete_model.hpp"

namespace fissura::support {

inline model::SteelSpec plain_steel() {
  model::SteelSpec s;
  s.name = "steel";
  s.E_s = 210e9, s.f_y = 530e6, s.f_u = 650e6, s.eps_sh = 0.03;
  return s;
}
inline model::BarSpec straight_bar(Vec3 from, Vec3 to, double diameter) {
  model::BarSpec b;
  b.name = "bar", b.steel = "steel";
  b.diameter = diameter;
  b.points = {from, to};
  return b;
}

inline model::Model reinforced_model(mesh::Mesh mesh, model::ConcreteSpec const& concrete,
                                     std::vector<model::BarSpec> const& bars,
                                     model::BarSettings settings = {}) {
  auto m = concrete_model(std::move(mesh), concrete);
  m.source.bars = bars;
  m.source.steels = {plain_steel()};
  m.source.bar_settings = settings;
  m.bars = rebar::embed_bars(m.mesh, m.adjacency, bars, m.source.steels, m.joint_of_shared_face).bars;
  std::vector<double> steel(static_cast<std::size_t>(node_count(m)), 0);
  rebar::add_steel_mass(m.bars, steel);
  model::add_steel_mass(m, steel);
  rebar::set_bar_joint_laws(m);
  m.overlay_tets = rebar::host_tets(m.bars);
  return m;
}

/// Every bar joint that can, has begun to slip: the stiffest the bars ever are.
inline void activate_bars(model::Model const& m, state::State& s) {
  rebar::activate_all(m, s.bars);
}

} // namespace fissura::support
