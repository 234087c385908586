#include "fissura/mesh/gmsh_reader.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <string_view>

#include <fmt/core.h>
#include <gmsh.h>

#include "fissura/core/ensure.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/gmsh_names.hpp"
#include "fissura/mesh/gmsh_session.hpp"
#include "fissura/mesh/msh_reader.hpp"
#include "fissura/mesh/renumber.hpp"

namespace fissura::mesh {

namespace {

namespace fs = std::filesystem;
using Tags = std::vector<std::size_t>;

constexpr std::uintmax_t largest_file = std::uintmax_t{8} << 30U; // bytes

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
  auto const size = fs::file_size(path, error);
  if (error || size > largest_file)
    refuse(path, fmt::format("the mesh file is larger than {} GiB", largest_file >> 30U));
  std::string text(size, '\0');
  std::ifstream in(path, std::ios::binary);
  if (size == 0 || !in.read(text.data(), static_cast<std::streamsize>(size)))
    refuse(path, "the mesh file cannot be read (is it empty, or not readable?)");
  return text;
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

/// Whether what stands in brackets from `at` on is sent to a file.
bool is_sent_to_a_file(std::string const& text, std::size_t at) {
  auto const open = text.find_first_not_of(" \t\n", at);
  if (open == std::string::npos || text[open] != '(') return false;
  auto const close = text.find(')', open);
  if (close == std::string::npos) return true; // never closed: no text that gmsh would take either
  auto const next = text.find_first_not_of(" \t\n", close + 1);
  return next != std::string::npos && text[next] == '>';
}

/// A .geo is a program: refuse the statements that would end this one, start others, write files, or read
/// others past this check.
void check_statements(fs::path const& path, std::string const& geo) {
  static std::set<std::string, std::less<>> const forbidden{
      "Exit",    "Abort", "SystemCall", "NonBlockingSystemCall", "OnelabRun", "Save", "Print", "Merge",
      "Include", "Open",  "CreateDir",  "ShapeFromFile"};
  auto const is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  std::string const text = blank_comments(geo);
  for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    end = at;
    while (end < text.size() && is_word(text[end])) ++end;
    std::string_view const word(text.data() + at, end - at);
    bool const writes = word == "Printf" && is_sent_to_a_file(text, end);
    if (!writes && !forbidden.contains(word)) continue;
    auto const line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    refuse(path,
           fmt::format(
               "statement '{}' is not allowed in the geometry of a case: it could start programs or touch "
               "other files (or mesh the file with gmsh, and name the .msh)",
               writes ? "Printf > file" : word),
           static_cast<int>(line));
  }
}

// ---- out of gmsh --------------------------------------------------------------------------------

/// What gmsh holds, on its way into a Mesh: what it would save.
struct Import {
  fs::path const& path;
  double unit; ///< metres per unit of gmsh's own coordinates
  Mesh mesh;
  Tags node_tags; ///< sorted; the rank of a tag is the point's index

  int point(std::size_t tag) const {
    auto const found = std::lower_bound(node_tags.begin(), node_tags.end(), tag);
    core::ensure(found != node_tags.end() && *found == tag,
                 "gmsh gave an element a node that it does not have");
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

double option(char const* name) {
  double value = 0;
  gmsh::option::getNumber(name, value);
  return value;
}

/// Whether gmsh would save entities in no physical group: it does when asked to, and when there is no group.
bool saves_all() {
  gmsh::vectorpair physicals;
  gmsh::model::getPhysicalGroups(physicals);
  return physicals.empty() || option("Mesh.SaveAll") != 0;
}

bool is_in_a_group(int volume) {
  std::vector<int> physicals;
  gmsh::model::getPhysicalGroupsForEntity(3, volume, physicals);
  return !physicals.empty();
}

std::size_t tets_of(int volume) {
  Tags tags, nodes;
  gmsh::model::mesh::getElementsByType(tet_4, tags, nodes, volume);
  return tags.size();
}

void note_volumes_left_out(Import& import, std::vector<int> const& volumes, std::size_t tets) {
  if (volumes.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < volumes.size() && i < 5; ++i)
    list += fmt::format("{}{}", i > 0 ? ", " : "", volumes[i]);
  import.mesh.doubts.push_back(fmt::format(
      "{}: left out, as gmsh does when it saves: volume{} {}{} ({} tets), in no physical group; name {} "
      "in a Physical Volume, or set Mesh.SaveAll = 1",
      import.path.string(), volumes.size() > 1 ? "s" : "", list, volumes.size() > 5 ? ", ..." : "", tets,
      volumes.size() > 1 ? "them" : "it"));
}

void import_tets(Import& import) {
  Mesh& m = import.mesh;
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  bool const all = saves_all();
  std::vector<int> left_out;
  std::size_t tets_left_out = 0;
  for (auto const& [dimension, entity] : volumes) {
    if (!all && !is_in_a_group(entity)) {
      left_out.push_back(entity);
      tets_left_out += tets_of(entity);
      continue;
    }
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
  if (m.tets.empty() && tets_left_out > 0)
    refuse(import.path,
           "the geometry has physical groups, but none of its volumes is in one: gmsh saves no tets of "
           "it; name a Physical Volume, or set Mesh.SaveAll = 1");
  note_volumes_left_out(import, left_out, tets_left_out);
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

} // namespace

Mesh read_gmsh(fs::path const& path, double length_unit, double element_size) {
  if (!(length_unit > 0)) refuse(path, fmt::format("length unit {:g} m: it must be positive", length_unit));
  bool const is_geometry = path.extension() == ".geo";
  if (!is_geometry && path.extension() != ".msh") refuse(path, "a mesh file ends in .msh or .geo");
  std::string const text = read_text(path);
  if (!is_geometry) {
    Mesh mesh = parse_msh(text, path.string(), length_unit);
    drop_unused_points(mesh);
    add_names_of_numbers(mesh);
    return mesh;
  }
  check_statements(path, text);

  Import import{path, length_unit, {}, {}};
  GmshSession const session(path);
  session.guard([&] {
    gmsh::open(path.string());
    double const scaling = option("Mesh.ScalingFactor");
    if (!(std::abs(scaling) > 0))
      refuse(path, fmt::format("Mesh.ScalingFactor = {:g}: it must not be zero", scaling));
    import.unit = length_unit * scaling;
    if (element_size > 0) {
      gmsh::option::setNumber("Mesh.MeshSizeMin", element_size / std::abs(import.unit));
      gmsh::option::setNumber("Mesh.MeshSizeMax", element_size / std::abs(import.unit));
    }
    gmsh::model::mesh::generate(3);
    import_nodes(import);
    import_tets(import);
    import_groups(import);
  });
  if (import.mesh.tets.empty()) refuse(path, "the geometry has no volume, so its mesh has no tets");
  drop_unused_points(import.mesh);
  add_names_of_numbers(import.mesh);
  return std::move(import.mesh);
}

} // namespace fissura::mesh
