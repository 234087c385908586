#pragma once
// A mesh from the nodes, elements and groups of a .msh file, whatever its format.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fissura/mesh/mesh.hpp"
#include "fissura/mesh/msh_scanner.hpp"
#include "fissura/mesh/msh_types.hpp"

namespace fissura::mesh {

/// What cannot be is refused where `scan` is: core::InputError.
class MshBuilder {
 public:
  using Groups = std::vector<std::int64_t>; ///< physical groups by number

  /// @param length_unit metres per length unit of the file
  /// @param file_size [bytes]; bounds the number of elements
  MshBuilder(MshScanner const& scan, double length_unit, std::size_t file_size)
      : scan_(scan), unit_(length_unit), most_items_(file_size / 6) {}

  void name_group(int dimension, std::int64_t group, std::string name) {
    names_[{dimension, group}] = std::move(name);
  }

  void make_room(std::size_t nodes);
  /// The tag of the next node; its point follows with add_point.
  void add_tag(std::uint64_t tag) { tags_.push_back(tag); }
  void add_point(Vec3 x) { mesh_.points.push_back(unit_ * x); }
  std::size_t tags() const { return tags_.size(); }
  /// Points by tag, in their own memory; of nodes with one tag the first stays.
  void sort_points();

  /// One element, whose nodes `next` reads one by one.
  template <class Next>
  void add(std::uint64_t tag, MshType const& type, int entity, Groups const& groups, Next const& next) {
    bool const is_used = check_type(type, groups);
    std::array<int, 4> nodes{};
    for (int k = 0; k < type.nodes; ++k) {
      auto const node = next();
      if (is_used) nodes[static_cast<std::size_t>(k)] = point(node);
    }
    type.number == tet_4 ? add_tet(tag, entity, groups, nodes) : add_item(type, entity, groups, nodes);
  }

  /// Tets volume by volume, groups by number; names without elements are empty groups.
  Mesh finish();

  static constexpr std::size_t most_groups = 100000; ///< more are no mesh that anybody made

 private:
  /// What a group of a lower dimension holds: the entity it came from, and up to three points.
  struct Item {
    int entity;
    std::array<int, 3> points;
  };

  int point(std::uint64_t tag) const;
  bool check_type(MshType const& type, Groups const& groups) const;
  void add_tet(std::uint64_t tag, int entity, Groups const& groups, std::array<int, 4> nodes);
  void add_item(MshType const& type, int entity, Groups const& groups, std::array<int, 4> const& nodes);
  std::string name_of(int dimension, std::int64_t group) const;
  int volume_name(int entity, Groups const& groups);
  template <class Group> int group_named(int dimension, std::vector<Group>& groups, std::string const& name);
  FaceGroup& face_group(std::string const& name);
  LineGroup& line_group(std::string const& name);
  PointGroup& point_group(std::string const& name);
  void sort_tets();
  void make_groups();
  void keep_empty_names();

  MshScanner const& scan_;
  double unit_;
  Mesh mesh_;
  std::vector<std::uint64_t> tags_; ///< of the points, ascending once they are sorted
  std::vector<int> entity_of_tet_;
  std::map<std::pair<int, std::int64_t>, std::string> names_;       ///< by dimension and number
  std::map<std::pair<int, std::int64_t>, std::vector<Item>> items_; ///< by dimension and group
  std::map<std::pair<int, std::string>, int> index_of_;             ///< of groups, by dimension and name
  std::size_t item_count_ = 0, most_items_; ///< an element takes at least six characters
  struct {
    int entity = 0;
    Groups groups;
    int index = -1;
  } last_volume_;
};

} // namespace fissura::mesh
