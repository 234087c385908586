#include "fissura/mesh/gmsh_reader.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <limits>
#include <sstream>

#include <fmt/format.h>
#include <gmsh.h>

#include "fissura/core/error.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/gmsh_session.hpp"
#include "fissura/mesh/renumber.hpp"

namespace fissura::mesh {

namespace {

namespace fs = std::filesystem;
using Tags = std::vector<std::size_t>;

/// gmsh's numbers of the element types this program knows.
enum ElementType { line_2 = 1, triangle_3 = 2, tet_4 = 4, point_1 = 15 };

[[noreturn]] void refuse(fs::path const& path, std::string message, int line = 0) {
  throw core::InputError({path.string(), line, 0}, std::move(message));
}

// ---- before gmsh sees the file ------------------------------------------------------------------

std::string read_text(fs::path const& path) {
  std::error_code error;
  if (!fs::exists(path, error)) refuse(path, "no such mesh file");
  if (!fs::is_regular_file(path, error)) refuse(path, "the mesh file is not a regular file");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || !text) refuse(path, "the mesh file cannot be read (is it empty, or not readable?)");
  return std::move(text).str();
}

/// gmsh would read a .msh that does not begin like one as a .geo, so its beginning is looked at here.
void check_format(fs::path const& path, std::string const& text) {
  auto const start = text.find("$MeshFormat");
  if (start == std::string::npos || !(start == 0 || text.starts_with("$Comments")))
    refuse(path, "not a gmsh mesh: it does not begin with $MeshFormat");
  std::istringstream line(text.substr(start + 11, 100));
  double version = 0;
  line >> version;
  if (version != 2.2 && version != 4.1)
    refuse(path, fmt::format("mesh format {:g}: only the formats 2.2 and 4.1 are read", version));
}

/// A .geo with its comments and strings blanked; lines stay where they are.
std::string blank_comments(std::string text) {
  std::size_t i = 0;
  auto const blank_to = [&](std::size_t end) {
    for (end = std::min(end, text.size()); i < end; ++i)
      if (text[i] != '\n') text[i] = ' ';
  };
  auto const after = [&](std::string const& mark, std::size_t from) {
    auto const found = text.find(mark, from);
    return found == std::string::npos ? text.size() : found + mark.size();
  };
  while (i < text.size()) {
    if (text.compare(i, 2, "//") == 0)
      blank_to(after("\n", i));
    else if (text.compare(i, 2, "/*") == 0)
      blank_to(after("*/", i + 2));
    else if (text[i] == '"')
      blank_to(after("\"", i + 1));
    else
      ++i;
  }
  return text;
}

/// A .geo is a program: refuse the statements that would end this one or start others.
void check_statements(fs::path const& path, std::string const& geo) {
  auto const is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  std::string const text = blank_comments(geo);
  for (std::string const statement : {"Exit", "Abort", "SystemCall", "NonBlockingSystemCall", "OnelabRun"})
    for (auto at = text.find(statement); at != std::string::npos; at = text.find(statement, at + 1)) {
      auto const end = at + statement.size();
      if ((at > 0 && is_word(text[at - 1])) || (end < text.size() && is_word(text[end]))) continue;
      refuse(path, fmt::format("statement '{}' is not allowed in the geometry of a case", statement),
             1 + static_cast<int>(
                     std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')));
    }
}

// ---- out of gmsh --------------------------------------------------------------------------------

/// What gmsh holds, on its way into a Mesh.
struct Import {
  fs::path const& path;
  double unit;
  Mesh mesh;
  Tags node_tags; ///< sorted; the rank of a tag is the point's index

  int point(std::size_t tag) const {
    auto const found = std::lower_bound(node_tags.begin(), node_tags.end(), tag);
    if (found == node_tags.end() || *found != tag)
      refuse(path, fmt::format("an element names node {}, which is not "
                               "in the mesh",
                               tag));
    return static_cast<int>(found - node_tags.begin());
  }
};

void import_nodes(Import& import) {
  Tags tags;
  std::vector<double> x, parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters);
  std::vector<std::pair<std::size_t, std::size_t>> order; // tag, position
  for (std::size_t i = 0; i < tags.size(); ++i) order.emplace_back(tags[i], i);
  std::sort(order.begin(), order.end());
  for (auto const& [tag, i] : order) {
    if (!import.node_tags.empty() && import.node_tags.back() == tag) continue;
    import.node_tags.push_back(tag);
    import.mesh.points.push_back(import.unit * Vec3{x[3 * i], x[3 * i + 1], x[3 * i + 2]});
  }
}

std::string name_of(int dimension, int physical) {
  std::string name;
  gmsh::model::getPhysicalName(dimension, physical, name);
  return name.empty() ? std::to_string(physical) : name;
}

/// Elements of one entity that must all be of one type; `what` names the entity in errors.
struct Elements {
  Tags tags, nodes;
};
Elements elements_of(Import const& import, int dimension, int entity, ElementType wanted,
                     std::string const& what) {
  std::vector<int> types;
  std::vector<Tags> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
  Elements found;
  for (std::size_t k = 0; k < types.size(); ++k) {
    if (types[k] == wanted) {
      found = {std::move(tags[k]), std::move(nodes[k])};
      continue;
    }
    std::string type;
    int d = 0, order = 0, count = 0, primary = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(types[k], type, d, order, count, local, primary);
    refuse(import.path,
           fmt::format("{} elements of type '{}' in {}: only first-order tetrahedra, triangles, lines and "
                       "points are known (no recombined or second-order mesh)",
                       tags[k].size(), type, what));
  }
  return found;
}

/// The volume group of a volume entity; groups are made when first met.
int volume_group(Import& import, int entity) {
  std::vector<int> physicals;
  gmsh::model::getPhysicalGroupsForEntity(3, entity, physicals);
  std::vector<std::string> names; // of its physical volumes, each once
  for (int p : physicals) names.push_back(name_of(3, std::abs(p)));
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  if (names.size() > 1)
    refuse(import.path,
           fmt::format("volume {} belongs to the physical volumes '{}': a tet has one material, so "
                       "physical volumes must not overlap",
                       entity, names[0] + "', '" + names[1]));
  std::string const name = names.empty() ? "default" : names[0];
  auto& groups = import.mesh.volume_groups;
  auto const found = std::find(groups.begin(), groups.end(), name);
  if (found == groups.end()) groups.push_back(name);
  return static_cast<int>(std::find(groups.begin(), groups.end(), name) - groups.begin());
}

void import_tets(Import& import) {
  Mesh& m = import.mesh;
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  for (auto const& [dimension, entity] : volumes) {
    auto const found = elements_of(import, 3, entity, tet_4, fmt::format("volume {}", entity));
    if (found.tags.empty()) continue;
    int const group = volume_group(import, entity);
    for (std::size_t i = 0; i < found.tags.size(); ++i) {
      std::array<int, 4> tet{};
      for (int k = 0; k < 4; ++k) tet[k] = import.point(found.nodes[4 * i + k]);
      m.tets.push_back(tet);
      if (geometry::volume(corners(m, static_cast<int>(m.tets.size()) - 1)) < 0)
        std::swap(m.tets.back()[0], m.tets.back()[1]);
      m.tet_group.push_back(group);
      m.input_id.push_back(
          static_cast<int>(std::min<std::size_t>(found.tags[i], std::numeric_limits<int>::max())));
    }
  }
}

/// The group of a name, made when first met: two physical groups of one name and dimension are one group.
template <class Groups> auto& group_named(Groups& groups, std::string const& name) {
  for (auto& g : groups)
    if (g.name == name) return g;
  groups.emplace_back().name = name;
  return groups.back();
}

/// Calls take(group name, its elements) for each physical group of one dimension.
template <class Take> void import_physicals(Import& import, int dimension, ElementType type, Take take) {
  gmsh::vectorpair physicals;
  gmsh::model::getPhysicalGroups(physicals, dimension);
  for (auto const& [d, physical] : physicals) {
    std::string const name = name_of(dimension, physical);
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, physical, entities);
    std::sort(entities.begin(), entities.end(), [](int a, int b) { return std::abs(a) < std::abs(b); });
    for (int entity : entities)
      take(name,
           elements_of(import, dimension, std::abs(entity), type, fmt::format("physical group '{}'", name)));
  }
}

void import_groups(Import& import) {
  Mesh& m = import.mesh;
  import_physicals(import, 2, triangle_3, [&](std::string const& name, Elements const& e) {
    auto& triangles = group_named(m.face_groups, name).triangles;
    for (std::size_t i = 0; i < e.nodes.size(); i += 3)
      triangles.push_back(
          {import.point(e.nodes[i]), import.point(e.nodes[i + 1]), import.point(e.nodes[i + 2])});
  });
  import_physicals(import, 1, line_2, [&](std::string const& name, Elements const& e) {
    auto& segments = group_named(m.line_groups, name).segments;
    for (std::size_t i = 0; i < e.nodes.size(); i += 2)
      segments.push_back({import.point(e.nodes[i]), import.point(e.nodes[i + 1])});
  });
  import_physicals(import, 0, point_1, [&](std::string const& name, Elements const& e) {
    auto& points = group_named(m.point_groups, name).points;
    for (std::size_t tag : e.nodes) points.push_back(import.point(tag));
  });
}

/// gmsh forgets the named groups of a .msh that have no elements; they are kept here so that the check finds
/// them.
void keep_empty_names(std::string const& text, Mesh& m) {
  auto const start = text.find("$PhysicalNames");
  if (start == std::string::npos) return;
  std::istringstream in(text.substr(start + 14, text.find("$EndPhysicalNames") - start - 14));
  int count = 0, dimension = 0, tag = 0;
  in >> count;
  while (count-- > 0 && in >> dimension >> tag) {
    std::string name;
    std::getline(std::getline(in, name, '"'), name, '"');
    if (name.empty()) continue;
    if (dimension == 3 &&
        std::find(m.volume_groups.begin(), m.volume_groups.end(), name) == m.volume_groups.end())
      m.volume_groups.push_back(name);
    if (dimension == 2) group_named(m.face_groups, name);
    if (dimension == 1) group_named(m.line_groups, name);
    if (dimension == 0) group_named(m.point_groups, name);
  }
}

} // namespace

Mesh read_gmsh(fs::path const& path, double length_unit, double element_size) {
  if (!(length_unit > 0)) refuse(path, fmt::format("length unit {:g} m: it must be positive", length_unit));
  bool const is_geometry = path.extension() == ".geo";
  if (!is_geometry && path.extension() != ".msh") refuse(path, "a mesh file ends in .msh or .geo");
  std::string const text = read_text(path);
  if (is_geometry)
    check_statements(path, text);
  else
    check_format(path, text);

  Import import{path, length_unit, {}, {}};
  GmshSession const session(path);
  session.guard([&] {
    gmsh::open(path.string());
    if (is_geometry) {
      if (element_size > 0) {
        gmsh::option::setNumber("Mesh.MeshSizeMin", element_size / length_unit);
        gmsh::option::setNumber("Mesh.MeshSizeMax", element_size / length_unit);
      }
      gmsh::model::mesh::generate(3);
    }
    import_nodes(import);
    import_tets(import);
    import_groups(import);
  });
  if (import.mesh.tets.empty())
    refuse(path,
           is_geometry ? "the geometry has no volume, so its mesh has no tets" : "the mesh has no tets");
  if (!is_geometry) keep_empty_names(text, import.mesh);
  drop_unused_points(import.mesh);
  return std::move(import.mesh);
}

} // namespace fissura::mesh
