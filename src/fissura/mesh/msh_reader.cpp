#include "fissura/mesh/msh_reader.hpp"

#include <array>
#include <cmath>
#include <fmt/core.h>
#include <map>

#include "fissura/core/error.hpp"
#include "fissura/mesh/msh_builder.hpp"

namespace fissura::mesh {

namespace {

constexpr std::size_t most_entities = 500000; ///< more are no mesh that anybody made

class Reading {
 public:
  Reading(std::string_view text, std::string const& file, double length_unit)
      : scan_(text, file), build_(scan_, length_unit, text.size()) {}

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
    return build_.finish();
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
    if (count > MshBuilder::most_groups)
      scan_.refuse(fmt::format("more than {} names", MshBuilder::most_groups));
    for (std::size_t i = 0; i < count; ++i) {
      auto const dimension = scan_.written_integer("the dimension of a group");
      auto const tag = scan_.written_integer("the number of a group");
      if (dimension < 0 || dimension > 3) scan_.refuse(fmt::format("a group of dimension {}", dimension));
      build_.name_group(static_cast<int>(dimension), tag, scan_.quoted("the name of a group"));
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
    if (build_.tags() > 0) scan_.refuse("a second section $Nodes");
    version_ == 2 ? read_nodes_2() : read_nodes_4();
    build_.sort_points();
  }

  void read_nodes_2() {
    auto const count =
        scan_.checked(scan_.written_integer("the number of nodes"), "the number of nodes", 8, 28);
    scan_.begin_bytes();
    build_.make_room(count);
    for (std::size_t i = 0; i < count; ++i) {
      int const tag = scan_.integer("the tag of a node");
      if (tag < 0) scan_.refuse(fmt::format("the tag {} of a node is negative", tag));
      build_.add_tag(static_cast<std::uint64_t>(tag));
      read_point();
    }
  }

  void read_nodes_4() {
    scan_.begin_bytes();
    auto const blocks = scan_.count("the number of blocks of nodes", 8, 20);
    auto const count = scan_.count("the number of nodes", 8, 32);
    scan_.size("the least tag"), scan_.size("the largest tag");
    build_.make_room(count);
    for (std::size_t b = 0; b < blocks; ++b) {
      int const dimension = scan_.integer("the dimension of an entity");
      scan_.integer("the tag of an entity");
      bool const has_parameters = scan_.integer("the mark of parameters") != 0;
      if (dimension < 0 || dimension > 3) scan_.refuse(fmt::format("an entity of dimension {}", dimension));
      auto const here = scan_.count("the number of nodes of a block", 8, 32);
      if (here > count - build_.tags())
        scan_.refuse(fmt::format("the blocks hold more nodes than the {} announced", count));
      for (std::size_t i = 0; i < here; ++i) build_.add_tag(scan_.size("the tag of a node"));
      for (std::size_t i = 0; i < here; ++i) {
        read_point();
        if (has_parameters) scan_.skip_numbers(static_cast<std::size_t>(dimension), "a parameter of a node");
      }
    }
    if (build_.tags() != count)
      scan_.refuse(fmt::format("the blocks hold {} of the {} nodes announced", build_.tags(), count));
  }

  void read_point() {
    Vec3 x;
    for (int r = 0; r < 3; ++r) x[r] = scan_.number("a coordinate of a node");
    for (int r = 0; r < 3; ++r)
      if (!(std::abs(x[r]) < 1e15)) scan_.refuse("a coordinate of a node is not finite, or beyond 1e15");
    build_.add_point(x);
  }

  // ---- elements ----------------------------------------------------------------------------------

  MshType const& properties(int type) const {
    for (auto const& t : msh_types)
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

  void take_2(int tag, MshType const& type, std::size_t tags) {
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
    build_.add(static_cast<std::uint64_t>(std::max(tag, 0)), type, entity, groups, [&] {
      return static_cast<std::uint64_t>(std::max(0, scan_.integer("a node of an element")));
    });
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
        build_.add(tag, type, entity, known == groups_of_.end() ? no_groups_ : known->second,
                   [&] { return scan_.size("a node of an element"); });
      }
    }
    if (taken != count)
      scan_.refuse(fmt::format("the blocks hold {} of the {} elements announced", taken, count));
  }

  MshScanner scan_;
  MshBuilder build_;
  int version_ = 0;                                             ///< 2 or 4
  std::map<std::pair<int, int>, MshBuilder::Groups> groups_of_; ///< by dimension and entity
  MshBuilder::Groups one_group_;
  MshBuilder::Groups const no_groups_;
};

} // namespace

Mesh parse_msh(std::string_view text, std::string const& file, double length_unit) {
  if (!text.starts_with('$'))
    throw core::InputError({file, 1, 1}, "not a gmsh mesh: it does not begin with $MeshFormat");
  return Reading(text, file, length_unit).read();
}

} // namespace fissura::mesh
