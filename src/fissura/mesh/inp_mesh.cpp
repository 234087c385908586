#include "fissura/mesh/inp_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/faces.hpp"
#include "fissura/mesh/inp_names.hpp"
#include "fissura/mesh/inp_resolve.hpp"
#include "fissura/mesh/inp_volumes.hpp"
#include "fissura/mesh/renumber.hpp"

namespace fissura::mesh::inp {

namespace {

constexpr std::size_t most_listed = 24;

/// Corners of the sides S1 ... S4 of a C3D4.
constexpr std::array<std::array<int, 3>, 4> side_corners{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};

/// Quarter turns are exact: parts that are turned by them keep common planes.
std::array<double, 2> cosine_and_sine(double degrees) {
  double const quarters = degrees / 90;
  if (quarters == std::floor(quarters) && std::abs(quarters) < 1e9) {
    constexpr std::array<std::array<double, 2>, 4> exact{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    return exact[static_cast<std::size_t>(((static_cast<long>(quarters) % 4) + 4) % 4)];
  }
  double const angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

Vec3 turned(Turn const& turn, Vec3 x) {
  auto const [c, s] = cosine_and_sine(turn.angle);
  Vec3 const axis = unit(turn.b - turn.a), r = x - turn.a;
  return turn.a + c * r + s * cross(axis, r) + ((1 - c) * dot(axis, r)) * axis;
}

/// A part after its numbers have been looked up.
struct Known {
  bool is_resolved = false;
  Volumes volumes;
  std::vector<int> tet;        ///< per element its rank among the tets, or -1
  std::vector<int> free_sides; ///< 4 x element + side: sides of tets that no other tet shares, ascending
  int tets = 0;
  std::size_t size = 0; ///< of a copy
};

class Builder {
 public:
  explicit Builder(Contents of_file) : contents(std::move(of_file)), resolver(contents) {}

  Mesh build() {
    choose_instances();
    for (std::size_t i = 0; i < contents.instances.size(); ++i) add_instance(i);
    if (m.tets.empty()) contents.refuse(0, "the file has no tets: no elements of type C3D4");
    resolver.resolve_assembly(point_start, element_start);
    add_rest();
    for (std::size_t i = 0; i < contents.instances.size(); ++i) add_sets_of_instance(i);
    add_sets_of_assembly();
    name_groups();
    report();
    drop_unused_points(m);
    return std::move(m);
  }

 private:
  // ---- instances --------------------------------------------------------------------------------

  /// A file without an assembly is one instance of itself, or of its only part.
  void choose_instances() {
    auto const& file = contents.parts.front();
    if (contents.parts.size() > 1 && !file.is_empty())
      contents.refuse(file.nodes.empty() ? file.elements.front().line : file.nodes.front().line,
                      "nodes or elements outside of every *PART, in a file with parts: put them into one");
    if (!contents.instances.empty()) {
      note_sets_of_nothing();
      return note_parts_without_instance();
    }
    if (contents.parts.size() > 2 || (contents.parts.size() == 2 && contents.has_assembly))
      contents.refuse(
          contents.parts.back().line,
          "parts without an *INSTANCE: nothing says which of them are in the model, and where; give "
          "*ASSEMBLY with *INSTANCEs");
    contents.instances.emplace_back();
    contents.instances.back().part = contents.parts.size() - 1;
  }

  /// Sets after the assembly, where its own nodes and elements end.
  void note_sets_of_nothing() {
    auto const& file = contents.parts.front();
    std::vector<std::string> names;
    for (auto const* sets : {&file.node_sets, &file.element_sets})
      for (auto const& set : sets->list) names.push_back(set.name);
    for (auto const& surface : file.surfaces) names.push_back(surface.name);
    note("left out: sets and surfaces outside of parts and assembly", names);
  }

  void note_parts_without_instance() {
    std::vector<char> used(contents.parts.size(), 0);
    for (auto const& i : contents.instances) {
      used[i.part] = 1;
      auto const origin = contents.part_of.find(in_capitals(contents.parts[i.part].name));
      if (origin != contents.part_of.end()) used[origin->second] = 1;
    }
    std::vector<std::string> names;
    for (std::size_t p = 1; p < used.size(); ++p)
      if (!used[p]) names.push_back(contents.parts[p].name);
    note("left out: parts without an *INSTANCE", names);
  }

  Scope const& part_of(std::size_t instance) const {
    return contents.parts[contents.instances[instance].part];
  }

  Known& known_of(std::size_t instance) {
    auto const p = contents.instances[instance].part;
    known.resize(contents.parts.size());
    auto& k = known[p];
    if (k.is_resolved) {
      contents.copy(k.size, contents.instances[instance].line);
      return k;
    }
    auto& part = contents.parts[p];
    resolver.resolve(part);
    k.is_resolved = true;
    k.volumes = volumes_of(contents, part);
    for (auto const& e : part.elements) k.tet.push_back(e.kind == Kind::tet ? k.tets++ : -1);
    k.size = part.nodes.size() + part.elements.size();
    for (auto const* sets : {&part.node_sets, &part.element_sets})
      for (auto const& set : sets->list) k.size += copies_per_set + 3 * set.members.size();
    for (auto const& surface : part.surfaces)
      k.size += copies_per_set + surface.sides.size() + surface.nodes.size();
    return k;
  }

  void add_instance(std::size_t i) {
    auto& instance = contents.instances[i];
    auto const& k = known_of(i);
    auto const& part = part_of(i);
    int const start = static_cast<int>(m.points.size());
    point_start.push_back(start);
    element_start.push_back(element_count);
    tet_start.push_back(static_cast<int>(m.tets.size()));
    if (m.points.size() + part.nodes.size() > most_indices ||
        static_cast<std::size_t>(element_count) + part.elements.size() > most_indices)
      contents.refuse(instance.line, "more nodes or elements than can be numbered");
    element_count += static_cast<int>(part.elements.size());
    for (auto const& n : part.nodes) {
      Vec3 x = n.x;
      if (instance.is_moved) x = x + instance.shift;
      if (instance.is_turned) x = turned(instance.turn, x);
      m.points.push_back(x);
    }
    for (auto const& e : part.elements) {
      if (e.kind != Kind::tet) continue;
      auto tet = e.nodes;
      for (int& p : tet) p += start;
      m.tets.push_back(tet);
      if (geometry::volume(corners(m, static_cast<int>(m.tets.size()) - 1)) < 0)
        std::swap(m.tets.back()[0], m.tets.back()[1]);
      m.input_id.push_back(
          static_cast<int>(std::min<long>(id_start + e.id, std::numeric_limits<int>::max())));
    }
    if (k.tets > 0) id_start += part.elements.back().id;
    add_volumes(i, k);
  }

  /// The volume groups of an instance; tets in none of them are counted in add_rest.
  void add_volumes(std::size_t i, Known const& k) {
    auto const& part = part_of(i);
    int const first = static_cast<int>(m.volume_groups.size());
    for (std::size_t e = 0; e < part.elements.size(); ++e)
      if (part.elements[e].kind == Kind::tet) {
        int const v = k.volumes.of_element[e];
        m.tet_group.push_back(v < 0 ? -1 : first + v);
      }
    for (int const s : k.volumes.sets) {
      auto const& set = part.element_sets.list[static_cast<std::size_t>(s)];
      volume_of.emplace(std::pair{static_cast<int>(i), s}, static_cast<int>(m.volume_groups.size()));
      m.volume_groups.push_back(set.name);
    }
  }

  void add_rest() {
    if (std::find(m.tet_group.begin(), m.tet_group.end(), -1) == m.tet_group.end()) return;
    int const rest = static_cast<int>(m.volume_groups.size());
    std::string name = "default";
    auto const is_taken = [&] {
      auto const has = [&](Scope const& s) { return s.element_sets.find(name) >= 0; };
      return has(contents.assembly) || std::any_of(contents.parts.begin(), contents.parts.end(), has);
    };
    while (is_taken()) name += "_";
    m.volume_groups.push_back(name);
    for (int& g : m.tet_group)
      if (g < 0) g = rest;
  }

  // ---- sets -------------------------------------------------------------------------------------

  /// An element of an instance by its number over all of them.
  struct Place {
    std::size_t instance = 0;
    Element const* element = nullptr;
    int tet = -1;                ///< of the mesh
    int index = 0;               ///< in its part
    std::array<int, 4> points{}; ///< of the mesh
  };
  Place place_of(std::size_t instance, int element) const {
    Place p;
    p.instance = instance;
    p.index = element;
    p.element = &part_of(instance).elements[static_cast<std::size_t>(element)];
    if (int const tet = known[contents.instances[instance].part].tet[static_cast<std::size_t>(element)];
        tet >= 0)
      p.tet = tet_start[instance] + tet;
    for (std::size_t k = 0; k < 4; ++k) p.points[k] = p.element->nodes[k] + point_start[instance];
    return p;
  }
  Place place_of(int element) const {
    auto const after = std::upper_bound(element_start.begin(), element_start.end(), element);
    auto const instance = static_cast<std::size_t>(after - element_start.begin()) - 1;
    return place_of(instance, element - element_start[instance]);
  }

  /// An element set is a curve, a surface and a volume, as far as it has elements of these kinds.
  template <class PlaceOf>
  void add_element_set(Set const& set, int instance, int volume, PlaceOf const& place) {
    std::array<Candidate, 4> by_dimension;
    for (int d = 1; d < 4; ++d) {
      auto& c = by_dimension[static_cast<std::size_t>(d)];
      c.dimension = d, c.name = set.name, c.instance = instance, c.line = set.line;
    }
    by_dimension[3].volume = volume;
    for (int const e : set.members) {
      Place const p = place(e);
      int const n = corners_of(p.element->kind);
      if (p.tet >= 0)
        by_dimension[3].items.push_back(p.tet);
      else if (n == 2 || (n == 3 && is_on_a_tet(p)))
        by_dimension[static_cast<std::size_t>(n - 1)].items.insert(
            by_dimension[static_cast<std::size_t>(n - 1)].items.end(), p.points.begin(),
            p.points.begin() + n);
    }
    bool const is_empty =
        std::all_of(by_dimension.begin(), by_dimension.end(), [](auto const& c) { return c.items.empty(); });
    if (is_empty) empty_sets.push_back(set.name);
    for (auto& c : by_dimension) add(std::move(c));
  }
  void add(Candidate c) {
    if (!c.items.empty()) candidates.push_back(std::move(c));
  }

  /// Shells that are no faces of tets are structures of their own.
  bool is_on_a_tet(Place const& p) {
    if (!finder) finder = std::make_unique<FaceFinder>(m);
    bool const is = !finder->find({p.points[0], p.points[1], p.points[2]}).empty();
    if (!is) shells_left_out.insert(p.element);
    return is;
  }

  void add_node_set(std::string const& name, int line, int instance, std::vector<int> points, int start) {
    if (points.empty()) empty_sets.push_back(name);
    for (int& p : points) p += start;
    Candidate c;
    c.name = name, c.line = line, c.instance = instance, c.items = std::move(points);
    add(std::move(c));
  }

  void add_sets_of_instance(std::size_t i) {
    auto const& part = part_of(i);
    int const number = static_cast<int>(i);
    for (std::size_t s = 0; s < part.element_sets.list.size(); ++s) {
      auto const v = volume_of.find({number, static_cast<int>(s)});
      int const volume = v == volume_of.end() ? -1 : v->second;
      add_element_set(part.element_sets.list[s], number, volume, [&](int e) { return place_of(i, e); });
    }
    for (auto const& set : part.node_sets.list)
      add_node_set(set.name, set.line, number, set.members, point_start[i]);
    for (auto const& surface : part.surfaces) add_surface(part, surface, number);
  }

  void add_sets_of_assembly() {
    auto const& assembly = contents.assembly;
    for (auto const& set : assembly.element_sets.list)
      add_element_set(set, -1, -1, [&](int e) { return place_of(e); });
    for (auto const& set : assembly.node_sets.list) add_node_set(set.name, set.line, -1, set.members, 0);
    for (auto const& surface : assembly.surfaces) add_surface(assembly, surface, -1);
  }

  // ---- surfaces ---------------------------------------------------------------------------------

  void add_surface(Scope const& scope, Surface const& surface, int instance) {
    if (!surface.nodes.empty())
      return add_node_set(surface.name, surface.line, instance, resolver.nodes_of(scope, surface.nodes),
                          instance >= 0 ? point_start[static_cast<std::size_t>(instance)] : 0);
    Candidate c;
    c.dimension = 2, c.name = surface.name, c.instance = instance, c.line = surface.line;
    for (auto const& side : surface.sides)
      for (int const e : resolver.elements_of(scope, side.elements))
        add_side(instance >= 0 ? place_of(static_cast<std::size_t>(instance), e) : place_of(e), side,
                 c.items);
    if (c.items.empty()) empty_sets.push_back(surface.name);
    add(std::move(c));
  }

  void add_side(Place const& p, Side const& side, std::vector<int>& to) {
    auto const& e = *p.element;
    if (e.kind == Kind::tet) {
      for (int f = 1; f <= 4; ++f)
        if (side.face == f || (side.face == 0 && is_free(p, f)))
          for (int const c : side_corners[static_cast<std::size_t>(f - 1)])
            to.push_back(p.points[static_cast<std::size_t>(c)]);
    } else if (side.face > 0 && e.kind != Kind::other) {
      contents.refuse(side.elements.line,
                      fmt::format("element {} has no side S{}: it is no tet", e.id, side.face));
    } else if (e.kind == Kind::triangle && is_on_a_tet(p)) {
      to.insert(to.end(), p.points.begin(), p.points.begin() + 3);
    }
  }

  /// Whether no other tet of the part shares side f = 1 ... 4 of a tet.
  bool is_free(Place const& p, int f) {
    auto const number = contents.instances[p.instance].part;
    auto& k = known[number];
    if (k.free_sides.empty()) find_free_sides(contents.parts[number], k);
    return std::binary_search(k.free_sides.begin(), k.free_sides.end(), 4 * p.index + f - 1);
  }

  void find_free_sides(Scope const& part, Known& k) const {
    struct Face {
      std::array<int, 3> nodes;
      int side;
    };
    std::vector<Face> faces;
    faces.reserve(4 * static_cast<std::size_t>(k.tets));
    for (std::size_t e = 0; e < part.elements.size(); ++e) {
      if (part.elements[e].kind != Kind::tet) continue;
      for (std::size_t f = 0; f < 4; ++f) {
        Face face{{}, static_cast<int>(4 * e + f)};
        for (std::size_t c = 0; c < 3; ++c)
          face.nodes[c] = part.elements[e].nodes[static_cast<std::size_t>(side_corners[f][c])];
        std::sort(face.nodes.begin(), face.nodes.end());
        faces.push_back(face);
      }
    }
    std::sort(faces.begin(), faces.end(), [](Face const& a, Face const& b) { return a.nodes < b.nodes; });
    for (std::size_t i = 0; i < faces.size(); ++i) {
      bool const alone = (i == 0 || faces[i - 1].nodes != faces[i].nodes) &&
                         (i + 1 == faces.size() || faces[i + 1].nodes != faces[i].nodes);
      if (alone) k.free_sides.push_back(faces[i].side);
    }
    std::sort(k.free_sides.begin(), k.free_sides.end());
  }

  // ---- names ------------------------------------------------------------------------------------

  void name_groups() {
    m.aliases = give_names(candidates, contents);
    group_sizes.assign(m.volume_groups.size(), 0);
    for (int const g : m.tet_group) ++group_sizes[static_cast<std::size_t>(g)];
    for (auto const& c : candidates)
      if (c.volume >= 0 && !c.own_name.empty())
        m.volume_groups[static_cast<std::size_t>(c.volume)] = c.own_name;
    for (auto& c : candidates)
      if (!c.own_name.empty()) make_group(c);
    follow_aliases();
  }

  void make_group(Candidate& c) {
    auto const& i = c.items;
    if (c.dimension == 0) {
      m.point_groups.push_back({c.own_name, std::move(c.items)});
    } else if (c.dimension == 1) {
      auto& segments = m.line_groups.emplace_back(LineGroup{c.own_name, {}}).segments;
      for (std::size_t k = 0; k < i.size(); k += 2) segments.push_back({i[k], i[k + 1]});
    } else if (c.dimension == 2) {
      auto& triangles = m.face_groups.emplace_back(FaceGroup{c.own_name, {}}).triangles;
      for (std::size_t k = 0; k < i.size(); k += 3) triangles.push_back({i[k], i[k + 1], i[k + 2]});
    } else if (c.volume < 0) {
      make_tet_set(c);
    }
    c.items = {};
  }

  /// A set of tets is another name for the volume groups that make it up, or a set of its own.
  void make_tet_set(Candidate& c) {
    std::vector<int> groups;
    for (int const t : c.items) groups.push_back(m.tet_group[static_cast<std::size_t>(t)]);
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    std::size_t sum = 0;
    for (int const g : groups) sum += group_sizes[static_cast<std::size_t>(g)];
    if (sum != c.items.size()) {
      m.tet_sets.push_back({c.own_name, std::move(c.items)});
      return;
    }
    GroupAlias alias{c.own_name, 3, {}, false};
    for (int const g : groups) alias.groups.push_back(m.volume_groups[static_cast<std::size_t>(g)]);
    unions.emplace(c.own_name, alias.groups);
    m.aliases.push_back(std::move(alias));
  }

  /// Aliases of sets that are themselves only names of volume groups.
  void follow_aliases() {
    for (auto& alias : m.aliases) {
      if (alias.dimension != 3 || alias.is_ambiguous || unions.contains(alias.name)) continue;
      std::vector<std::string> groups;
      for (auto const& g : alias.groups) {
        auto const known_as = unions.find(g);
        if (known_as == unions.end())
          groups.push_back(g);
        else
          groups.insert(groups.end(), known_as->second.begin(), known_as->second.end());
      }
      std::sort(groups.begin(), groups.end());
      groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
      alias.groups = std::move(groups);
    }
  }

  // ---- report -----------------------------------------------------------------------------------

  void note(char const* what, std::vector<std::string> const& names) {
    if (names.empty()) return;
    std::string list;
    for (std::size_t i = 0; i < names.size() && i < most_listed; ++i)
      list += fmt::format("{}\"{}\"", i > 0 ? ", " : "", shown(names[i]));
    contents.notes.push_back(
        fmt::format("{}: {}: {}{}", contents.file, what, list, names.size() > most_listed ? ", ..." : ""));
  }

  void report() {
    if (!shells_left_out.empty())
      contents.notes.push_back(fmt::format("{}: left out: {} three-node shells that are no faces of tets",
                                           contents.file, shells_left_out.size()));
    note("sets that hold nothing of the mesh (reference points, elements left out)", empty_sets);
    m.notes = std::move(contents.notes);
    m.doubts = std::move(contents.doubts);
  }

  static constexpr std::size_t most_indices = 500'000'000; ///< four sides of an element have numbers as well

  Contents contents;
  Resolver resolver;
  Mesh m;
  std::vector<Known> known;                               ///< by part
  std::vector<int> point_start, element_start, tet_start; ///< by instance
  int element_count = 0;
  long id_start = 0;
  std::map<std::pair<int, int>, int> volume_of; ///< index of the volume group of an instance's element set
  std::vector<Candidate> candidates;
  std::vector<std::size_t> group_sizes;
  std::map<std::string, std::vector<std::string>> unions;
  std::unique_ptr<FaceFinder> finder;
  std::set<Element const*> shells_left_out;
  std::vector<std::string> empty_sets;
};

} // namespace

Mesh make_mesh(Contents contents) {
  return Builder(std::move(contents)).build();
}

} // namespace fissura::mesh::inp
