#include "fissura/mesh/msh_reader.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numeric>
#include <type_traits>
#include <utility>

#include "fissura/core/error.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/msh_scanner.hpp"

namespace fissura::mesh {

namespace {

/// gmsh's numbers of the element types this program knows.
enum ElementType { line_2 = 1, triangle_3 = 2, tet_4 = 4, point_1 = 15 };

struct TypeProperties {
  int number, dimension, nodes;
  char const* name;
};
/// The types that gmsh writes for meshes of first to third order; lines of other types cannot be passed over
/// in a file of bytes.
constexpr TypeProperties types[] = {{1, 1, 2, "Line 2"},
                                    {2, 2, 3, "Triangle 3"},
                                    {3, 2, 4, "Quadrilateral 4"},
                                    {4, 3, 4, "Tetrahedron 4"},
                                    {5, 3, 8, "Hexahedron 8"},
                                    {6, 3, 6, "Prism 6"},
                                    {7, 3, 5, "Pyramid 5"},
                                    {8, 1, 3, "Line 3"},
                                    {9, 2, 6, "Triangle 6"},
                                    {10, 2, 9, "Quadrilateral 9"},
                                    {11, 3, 10, "Tetrahedron 10"},
                                    {12, 3, 27, "Hexahedron 27"},
                                    {13, 3, 18, "Prism 18"},
                                    {14, 3, 14, "Pyramid 14"},
                                    {15, 0, 1, "Point"},
                                    {16, 2, 8, "Quadrilateral 8"},
                                    {17, 3, 20, "Hexahedron 20"},
                                    {18, 3, 15, "Prism 15"},
                                    {19, 3, 13, "Pyramid 13"},
                                    {21, 2, 10, "Triangle 10"},
                                    {26, 1, 4, "Line 4"},
                                    {29, 3, 20, "Tetrahedron 20"},
                                    {36, 2, 16, "Quadrilateral 16"}};

/// More names, groups or entities than this are no mesh that anybody made.
constexpr std::size_t most_groups = 100000, most_entities = 500000;

/// What a group of a lower dimension holds: the entity it came from, and up to three points.
struct Item {
  int entity;
  std::array<int, 3> points;
};

class Reading {
 public:
  Reading(std::string_view text, std::string const& file, double length_unit)
      : scan_(text, file), unit_(length_unit), most_items_(text.size() / 6) {}

  Mesh read() {
    for (auto name = scan_.next_section(); !name.empty(); name = scan_.next_section()) {
      if (name == "MeshFormat")
        read_format();
      else if (version_ == 0) {
        read_comments(name);
        continue;
      } else if (name == "PhysicalNames")
        read_names();
      else if (name == "Entities" && version_ == 4)
        read_entities();
      else if (name == "PartitionedEntities")
        scan_.refuse("this mesh is cut into partitions; save it in one piece (gmsh: Mesh.NbPartitions = 0)");
      else if (name == "Nodes")
        read_nodes();
      else if (name == "Elements")
        read_elements();
      else {
        scan_.skip_section(name);
        continue;
      }
      scan_.end_section(name);
    }
    if (version_ == 0) scan_.refuse("the file has no section $MeshFormat");
    return finish();
  }

 private:
  // ---- sections ----------------------------------------------------------------------------------

  /// Nothing else may come before the format.
  void read_comments(std::string_view name) {
    if (name != "Comments") scan_.refuse("not a gmsh mesh: it does not begin with $MeshFormat");
    scan_.skip_section(name);
  }

  void read_format() {
    double const version = scan_.written_number("the version of the format");
    if (version != 2.2 && version != 4.1)
      scan_.refuse(fmt::format("mesh format {:g}: only the formats 2.2 and 4.1 are read", version));
    version_ = version > 3 ? 4 : 2;
    auto const kind = scan_.written_integer("the kind of the file");
    if (kind != 0 && kind != 1) scan_.refuse(fmt::format("file type {}: it is 0 (text) or 1 (binary)", kind));
    if (auto const size = scan_.written_integer("the size of a number"); size != 8)
      scan_.refuse(fmt::format("numbers of {} bytes: only 8 are read", size));
    if (kind == 0) return;
    scan_.is_binary = true;
    scan_.begin_bytes();
    if (scan_.integer("the order of bytes") != 1)
      scan_.refuse("the bytes are in another order (big-endian); save the mesh as text");
  }

  void read_names() {
    auto const count =
        scan_.checked(scan_.written_integer("the number of names"), "the number of names", 7, 7);
    if (count > most_groups) scan_.refuse(fmt::format("more than {} names", most_groups));
    for (std::size_t i = 0; i < count; ++i) {
      auto const dimension = scan_.written_integer("the dimension of a group");
      auto const tag = scan_.written_integer("the number of a group");
      if (dimension < 0 || dimension > 3) scan_.refuse(fmt::format("a group of dimension {}", dimension));
      names_[{static_cast<int>(dimension), tag}] = scan_.quoted("the name of a group");
    }
  }

  void read_entities() {
    scan_.begin_bytes();
    std::array<std::size_t, 4> counts;
    for (auto& n : counts) {
      n = scan_.count("the number of entities", 8, 36);
      if (n > most_entities) scan_.refuse(fmt::format("more than {} entities", most_entities));
    }
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) read_entity(dimension);
  }

  void read_entity(int dimension) {
    int const tag = scan_.integer("the tag of an entity");
    scan_.skip_numbers(dimension == 0 ? 3 : 6, "the extent of an entity");
    auto const groups = scan_.count("the number of groups of an entity", 2, 4);
    for (std::size_t i = 0; i < groups; ++i) {
      int const group = scan_.integer("the number of a group");
      groups_of_[{dimension, tag}].push_back(std::abs(static_cast<std::int64_t>(group)));
    }
    if (dimension == 0) return;
    auto const bounds = scan_.count("the number of bounds of an entity", 2, 4);
    for (std::size_t i = 0; i < bounds; ++i) scan_.integer("a bound of an entity");
  }

  void read_nodes() {
    if (!tags_.empty()) scan_.refuse("a second section $Nodes");
    version_ == 2 ? read_nodes_2() : read_nodes_4();
    sort_nodes();
  }

  void read_nodes_2() {
    auto const count =
        scan_.checked(scan_.written_integer("the number of nodes"), "the number of nodes", 8, 28);
    scan_.begin_bytes();
    make_room(count);
    for (std::size_t i = 0; i < count; ++i) {
      int const tag = scan_.integer("the tag of a node");
      if (tag < 0) scan_.refuse(fmt::format("the tag {} of a node is negative", tag));
      tags_.push_back(static_cast<std::uint64_t>(tag));
      read_point();
    }
  }

  void read_nodes_4() {
    scan_.begin_bytes();
    auto const blocks = scan_.count("the number of blocks of nodes", 8, 20);
    auto const count = scan_.count("the number of nodes", 8, 32);
    scan_.size("the least tag"), scan_.size("the largest tag");
    make_room(count);
    for (std::size_t b = 0; b < blocks; ++b) {
      int const dimension = scan_.integer("the dimension of an entity");
      scan_.integer("the tag of an entity");
      bool const has_parameters = scan_.integer("the mark of parameters") != 0;
      if (dimension < 0 || dimension > 3) scan_.refuse(fmt::format("an entity of dimension {}", dimension));
      auto const here = scan_.count("the number of nodes of a block", 8, 32);
      if (here > count - tags_.size())
        scan_.refuse(fmt::format("the blocks hold more nodes than the {} announced", count));
      for (std::size_t i = 0; i < here; ++i) tags_.push_back(scan_.size("the tag of a node"));
      for (std::size_t i = 0; i < here; ++i) {
        read_point();
        if (has_parameters) scan_.skip_numbers(static_cast<std::size_t>(dimension), "a parameter of a node");
      }
    }
    if (tags_.size() != count)
      scan_.refuse(fmt::format("the blocks hold {} of the {} nodes announced", tags_.size(), count));
  }

  void make_room(std::size_t nodes) {
    tags_.reserve(nodes);
    mesh_.points.reserve(nodes);
  }

  void read_point() {
    Vec3 x;
    for (int r = 0; r < 3; ++r) x[r] = scan_.number("a coordinate of a node");
    for (int r = 0; r < 3; ++r)
      if (!(std::abs(x[r]) < 1e15)) scan_.refuse("a coordinate of a node is not finite, or beyond 1e15");
    mesh_.points.push_back(unit_ * x);
  }

  /// Points by tag, in their own memory; of nodes with one tag the first stays.
  void sort_nodes() {
    if (std::is_sorted(tags_.begin(), tags_.end(), std::less_equal<>())) return;
    std::vector<std::uint32_t> from(tags_.size());
    std::iota(from.begin(), from.end(), 0U);
    std::stable_sort(from.begin(), from.end(), [&](auto a, auto b) { return tags_[a] < tags_[b]; });
    for (std::uint32_t start = 0; start < from.size(); ++start) { // cycle by cycle
      auto const tag = tags_[start];
      Vec3 const x = mesh_.points[start];
      std::uint32_t to = start;
      while (from[to] != start) {
        tags_[to] = tags_[from[to]], mesh_.points[to] = mesh_.points[from[to]];
        to = std::exchange(from[to], to);
      }
      tags_[to] = tag, mesh_.points[to] = x;
      from[to] = to;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < tags_.size(); ++i) {
      if (kept > 0 && tags_[kept - 1] == tags_[i]) continue;
      tags_[kept] = tags_[i], mesh_.points[kept] = mesh_.points[i];
      ++kept;
    }
    tags_.resize(kept), mesh_.points.resize(kept);
  }

  int point(std::uint64_t tag) const {
    // Most files count their nodes from 1 without a gap.
    if (tag >= 1 && tag <= tags_.size() && tags_[tag - 1] == tag) return static_cast<int>(tag - 1);
    auto const found = std::lower_bound(tags_.begin(), tags_.end(), tag);
    if (found == tags_.end() || *found != tag)
      scan_.refuse(fmt::format("an element names node {}, which is not in the mesh", tag));
    return static_cast<int>(found - tags_.begin());
  }

  // ---- elements ----------------------------------------------------------------------------------

  TypeProperties const& properties(int type) const {
    for (auto const& t : types)
      if (t.number == type) return t;
    scan_.refuse(fmt::format("elements of type {}: only first-order tetrahedra, triangles, lines and points "
                             "are known (no recombined or higher-order mesh)",
                             type));
  }

  void read_elements() {
    if (version_ == 4) return read_elements_4();
    auto const count =
        scan_.checked(scan_.written_integer("the number of elements"), "the number of elements", 6, 4);
    scan_.begin_bytes();
    for (std::size_t i = 0; i < count;)
      if (scan_.is_binary)
        i += read_run_2(count - i);
      else
        read_line_2(), ++i;
  }

  void read_line_2() {
    int const tag = scan_.integer("the number of an element");
    auto const& type = properties(scan_.integer("the type of an element"));
    take_2(tag, type, static_cast<std::size_t>(number_of_tags()));
  }

  /// Elements of one type, in a file of bytes.
  std::size_t read_run_2(std::size_t most) {
    auto const& type = properties(scan_.integer("the type of elements"));
    auto const here = scan_.checked(scan_.integer("the number of elements of a type"),
                                    "the number of elements of a type", 1, 4);
    if (here < 1 || here > most)
      scan_.refuse(fmt::format("{} elements of a type where {} are left", here, most));
    int const tags = number_of_tags();
    for (std::size_t i = 0; i < here; ++i)
      take_2(scan_.integer("the number of an element"), type, static_cast<std::size_t>(tags));
    return here;
  }

  int number_of_tags() {
    int const tags = scan_.integer("the number of tags of an element");
    if (tags < 0 || tags > 1000) scan_.refuse(fmt::format("an element with {} tags", tags));
    return tags;
  }

  void take_2(int tag, TypeProperties const& type, std::size_t tags) {
    std::int64_t group = 0;
    int entity = 0;
    for (std::size_t i = 0; i < tags; ++i) {
      int const value = scan_.integer("a tag of an element");
      if (i == 0) group = std::abs(static_cast<std::int64_t>(value));
      if (i == 1) entity = value;
    }
    auto& groups = one_group_;
    groups.clear();
    if (group != 0) groups.push_back(group);
    take(static_cast<std::uint64_t>(std::max(tag, 0)), type, entity, groups,
         [&] { return static_cast<std::uint64_t>(std::max(0, scan_.integer("a node of an element"))); });
  }

  void read_elements_4() {
    scan_.begin_bytes();
    auto const blocks = scan_.count("the number of blocks of elements", 8, 20);
    auto const count = scan_.count("the number of elements", 3, 16);
    scan_.size("the least tag"), scan_.size("the largest tag");
    std::size_t taken = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
      scan_.integer("the dimension of an entity");
      int const entity = scan_.integer("the tag of an entity");
      auto const& type = properties(scan_.integer("the type of elements"));
      auto const here = scan_.count("the number of elements of a block", 3, 16);
      if (here > count - taken)
        scan_.refuse(fmt::format("the blocks hold more elements than the {} announced", count));
      taken += here;
      auto const known = groups_of_.find({type.dimension, entity});
      for (std::size_t i = 0; i < here; ++i) {
        auto const tag = scan_.size("the number of an element");
        take(tag, type, entity, known == groups_of_.end() ? no_groups_ : known->second,
             [&] { return scan_.size("a node of an element"); });
      }
    }
    if (taken != count)
      scan_.refuse(fmt::format("the blocks hold {} of the {} elements announced", taken, count));
  }

  /// One element, whose nodes `next` reads one by one.
  template <class Next>
  void take(std::uint64_t tag, TypeProperties const& type, int entity,
            std::vector<std::int64_t> const& groups, Next const& next) {
    bool const is_simplex =
        type.number == line_2 || type.number == triangle_3 || type.number == tet_4 || type.number == point_1;
    if (!is_simplex && (type.dimension == 3 || !groups.empty()))
      scan_.refuse(fmt::format("elements of type '{}': only first-order tetrahedra, triangles, lines and "
                               "points are known (no recombined or higher-order mesh)",
                               type.name));
    std::array<int, 4> nodes{};
    for (int k = 0; k < type.nodes; ++k) {
      auto const node = next();
      if (is_simplex && (type.dimension == 3 || !groups.empty()))
        nodes[static_cast<std::size_t>(k)] = point(node);
    }
    if (type.number == tet_4) return take_tet(tag, entity, groups, nodes);
    for (auto const group : groups) {
      if (++item_count_ > most_items_ || items_.size() > most_groups)
        scan_.refuse("an element lies in too many groups, or there are too many of them");
      items_[{type.dimension, group}].push_back({entity, {nodes[0], nodes[1], nodes[2]}});
    }
  }

  void take_tet(std::uint64_t tag, int entity, std::vector<std::int64_t> const& groups,
                std::array<int, 4> nodes) {
    auto const name = volume_name(entity, groups);
    auto const corner = [&](int k) {
      return mesh_.points[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])];
    };
    if (geometry::volume({corner(0), corner(1), corner(2), corner(3)}) < 0) std::swap(nodes[0], nodes[1]);
    mesh_.tets.push_back(nodes);
    mesh_.tet_group.push_back(name);
    mesh_.input_id.push_back(static_cast<int>(std::min<std::uint64_t>(tag, std::numeric_limits<int>::max())));
    entity_of_tet_.push_back(entity);
  }

  // ---- groups ------------------------------------------------------------------------------------

  std::string name_of(int dimension, std::int64_t group) const {
    auto const found = names_.find({dimension, group});
    return found == names_.end() || found->second.empty() ? std::to_string(group) : found->second;
  }

  /// Index of the one volume group of a tet.
  int volume_name(int entity, std::vector<std::int64_t> const& groups) {
    if (last_volume_.index >= 0 && last_volume_.entity == entity && last_volume_.groups == groups)
      return last_volume_.index;
    std::vector<std::string> names; // of its physical volumes, each once
    for (auto const g : groups) names.push_back(name_of(3, g));
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    if (names.size() > 1)
      scan_.refuse(
          fmt::format("volume {} belongs to the physical volumes '{}', '{}': a tet has one material, "
                      "so physical volumes must not overlap",
                      entity, names[0], names[1]));
    std::string const name = names.empty() ? "default" : names[0];
    int const index = group_named(3, mesh_.volume_groups, name);
    last_volume_ = {entity, groups, index};
    return index;
  }

  /// Tets volume by volume, and their groups in that order.
  void sort_tets() {
    std::size_t const count = mesh_.tets.size();
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return entity_of_tet_[static_cast<std::size_t>(a)] < entity_of_tet_[static_cast<std::size_t>(b)];
    });
    auto const sorted = [&]<class T>(std::vector<T> const& from) {
      std::vector<T> to;
      to.reserve(count);
      for (int const i : order) to.push_back(from[static_cast<std::size_t>(i)]);
      return to;
    };
    mesh_.tets = sorted(mesh_.tets);
    mesh_.tet_group = sorted(mesh_.tet_group);
    mesh_.input_id = sorted(mesh_.input_id);
    std::vector<std::string> groups;
    std::vector<int> place(mesh_.volume_groups.size(), -1);
    for (int& g : mesh_.tet_group) {
      auto const old = static_cast<std::size_t>(g);
      if (place[old] < 0)
        place[old] = static_cast<int>(groups.size()), groups.push_back(mesh_.volume_groups[old]);
      g = place[old];
    }
    for (std::size_t i = 0; i < groups.size(); ++i) index_of_[{3, groups[i]}] = static_cast<int>(i);
    mesh_.volume_groups = std::move(groups);
  }

  /// Index of the group of a name, made when first met: two physical groups of one name and dimension are
  /// one.
  template <class Group> int group_named(int dimension, std::vector<Group>& groups, std::string const& name) {
    auto const [known, is_new] = index_of_.insert({{dimension, name}, static_cast<int>(groups.size())});
    if (is_new) {
      if (groups.size() >= most_groups) scan_.refuse(fmt::format("more than {} groups", most_groups));
      groups.emplace_back();
      if constexpr (std::is_same_v<Group, std::string>)
        groups.back() = name;
      else
        groups.back().name = name;
    }
    return known->second;
  }
  FaceGroup& face_group(std::string const& name) {
    return mesh_.face_groups[static_cast<std::size_t>(group_named(2, mesh_.face_groups, name))];
  }
  LineGroup& line_group(std::string const& name) {
    return mesh_.line_groups[static_cast<std::size_t>(group_named(1, mesh_.line_groups, name))];
  }
  PointGroup& point_group(std::string const& name) {
    return mesh_.point_groups[static_cast<std::size_t>(group_named(0, mesh_.point_groups, name))];
  }

  void make_groups() {
    for (auto& [key, items] : items_) {
      auto const& [dimension, group] = key;
      std::string const name = name_of(dimension, group);
      std::stable_sort(items.begin(), items.end(),
                       [](Item const& a, Item const& b) { return a.entity < b.entity; });
      for (auto const& item : items) {
        auto const& p = item.points;
        if (dimension == 2) face_group(name).triangles.push_back(p);
        if (dimension == 1) line_group(name).segments.push_back({p[0], p[1]});
        if (dimension == 0) point_group(name).points.push_back(p[0]);
      }
    }
  }

  /// Names without elements become empty groups, so that the check finds them.
  void keep_empty_names() {
    for (auto const& [key, name] : names_) {
      if (name.empty()) continue;
      if (key.first == 3) group_named(3, mesh_.volume_groups, name);
      if (key.first == 2) face_group(name);
      if (key.first == 1) line_group(name);
      if (key.first == 0) point_group(name);
    }
  }

  Mesh finish() {
    if (mesh_.tets.empty()) scan_.refuse("the mesh has no tets");
    sort_tets();
    make_groups();
    keep_empty_names();
    return std::move(mesh_);
  }

  MshScanner scan_;
  double unit_;
  int version_ = 0; ///< 2 or 4
  Mesh mesh_;
  std::vector<std::uint64_t> tags_; ///< of the points, ascending once the section is read
  std::vector<int> entity_of_tet_;
  std::map<std::pair<int, std::int64_t>, std::string> names_;          ///< by dimension and number
  std::map<std::pair<int, int>, std::vector<std::int64_t>> groups_of_; ///< by dimension and entity
  std::map<std::pair<int, std::int64_t>, std::vector<Item>> items_;    ///< by dimension and group
  std::map<std::pair<int, std::string>, int> index_of_;                ///< of groups, by dimension and name
  std::size_t item_count_ = 0, most_items_; ///< an element takes at least six characters
  std::vector<std::int64_t> one_group_;
  std::vector<std::int64_t> const no_groups_;
  struct {
    int entity = 0;
    std::vector<std::int64_t> groups;
    int index = -1;
  } last_volume_;
};

} // namespace

Mesh parse_msh(std::string_view text, std::string const& file, double length_unit) {
  if (!text.starts_with('$'))
    throw core::InputError({file, 1, 1}, "not a gmsh mesh: it does not begin with $MeshFormat");
  return Reading(text, file, length_unit).read();
}

} // namespace fissura::mesh
