#include "fissura/mesh/gmsh_names.hpp"

namespace fissura::mesh {

void add_names_of_numbers(Mesh& m) {
  auto const add = [&](int dimension, char const* kind, std::string const& name) {
    bool const is_number = !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
    if (is_number) m.aliases.push_back({kind + name, dimension, {name}, false});
  };
  for (auto const& name : m.volume_groups) add(3, "PhysicalVolume", name);
  for (auto const& g : m.face_groups) add(2, "PhysicalSurface", g.name);
  for (auto const& g : m.line_groups) add(1, "PhysicalLine", g.name);
  for (auto const& g : m.point_groups) add(0, "PhysicalPoint", g.name);
}

} // namespace fissura::mesh
