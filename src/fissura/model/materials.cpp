#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "fissura/core/text.hpp"
#include "fissura/mesh/groups.hpp"
#include "fissura/model/make_blocks.hpp"

namespace fissura::model {

double default_fracture_energy(double f_c) {
  return 73 * std::pow(f_c * 1e-6, 0.18);
}

double default_cohesion(double f_c, double friction_angle) {
  return f_c * (1 - std::sin(friction_angle)) / (2 * std::cos(friction_angle));
}

namespace {

std::string no_volume_group(mesh::Mesh const& mesh, std::string const& name) {
  if (!mesh::tets_named(mesh, name, {}).empty())
    return fmt::format(
        "`{}` is a set of tets across the materials of the mesh file, so no material here; the "
        "volume groups are: {}",
        name, core::joined(mesh.volume_groups, ", "));
  return fmt::format("the mesh has no volume group `{}`; it has: {}", name,
                     core::joined(mesh.volume_groups, ", "));
}

} // namespace

std::vector<int> assign_materials(Case const& c, mesh::Mesh const& mesh) {
  std::vector<core::Diagnostic> wrong;
  std::vector<int> concrete_of_group(mesh.volume_groups.size(), -1);
  int catch_all = -1;
  for (std::size_t i = 0; i < c.concretes.size(); ++i) {
    auto const& concrete = c.concretes[i];
    if (concrete.groups.empty()) {
      if (catch_all >= 0)
        wrong.push_back({concrete.place,
                         fmt::format("[[concrete]] `{}` names no groups, but `{}` already takes all the rest",
                                     concrete.name, c.concretes[catch_all].name)});
      catch_all = static_cast<int>(i);
    }
    for (auto const& name : concrete.groups) {
      auto const found = mesh::groups_named(mesh, 3, name, concrete.place);
      if (found.empty()) wrong.push_back({concrete.place, no_volume_group(mesh, name)});
      for (int const g : found) {
        int& owner = concrete_of_group[static_cast<std::size_t>(g)];
        if (owner >= 0)
          wrong.push_back(
              {concrete.place,
               fmt::format("volume group `{}` already belongs to [[concrete]] `{}`",
                           mesh.volume_groups[static_cast<std::size_t>(g)], c.concretes[owner].name)});
        owner = static_cast<int>(i);
      }
    }
  }
  for (std::size_t g = 0; g < concrete_of_group.size(); ++g) {
    if (concrete_of_group[g] < 0) concrete_of_group[g] = catch_all;
    if (concrete_of_group[g] < 0)
      wrong.push_back(
          {c.mesh.place, fmt::format("volume group `{}` has no [[concrete]]: name it in `groups` of one",
                                     mesh.volume_groups[g])});
  }
  if (!wrong.empty()) throw core::InputError(std::move(wrong));
  std::vector<int> material(mesh.tets.size());
  for (std::size_t t = 0; t < material.size(); ++t) material[t] = concrete_of_group[mesh.tet_group[t]];
  return material;
}

} // namespace fissura::model
