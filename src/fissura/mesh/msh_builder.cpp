#include "fissura/mesh/msh_builder.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <limits>
#include <numeric>
#include <type_traits>

#include "fissura/geometry/tet.hpp"

namespace fissura::mesh {

// ---- points --------------------------------------------------------------------------------------

void MshBuilder::make_room(std::size_t nodes) {
  tags_.reserve(nodes);
  mesh_.points.reserve(nodes);
}

void MshBuilder::sort_points() {
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

int MshBuilder::point(std::uint64_t tag) const {
  // Most files count their nodes from 1 without a gap.
  if (tag >= 1 && tag <= tags_.size() && tags_[tag - 1] == tag) return static_cast<int>(tag - 1);
  auto const found = std::lower_bound(tags_.begin(), tags_.end(), tag);
  if (found == tags_.end() || *found != tag)
    scan_.refuse(fmt::format("an element names node {}, which is not in the mesh", tag));
  return static_cast<int>(found - tags_.begin());
}

// ---- elements ------------------------------------------------------------------------------------

/// Whether the element's nodes are wanted. Others may stand in a file if they belong to no group.
bool MshBuilder::check_type(MshType const& type, Groups const& groups) const {
  bool const is_simplex =
      type.number == line_2 || type.number == triangle_3 || type.number == tet_4 || type.number == point_1;
  bool const matters = type.dimension == 3 || !groups.empty();
  if (!is_simplex && matters)
    scan_.refuse(fmt::format("elements of type '{}': only first-order tetrahedra, triangles, lines and "
                             "points are known (no recombined or higher-order mesh)",
                             type.name));
  return matters;
}

void MshBuilder::add_tet(std::uint64_t tag, int entity, Groups const& groups, std::array<int, 4> nodes) {
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

void MshBuilder::add_item(MshType const& type, int entity, Groups const& groups,
                          std::array<int, 4> const& nodes) {
  for (auto const group : groups) {
    if (++item_count_ > most_items_ || items_.size() > most_groups)
      scan_.refuse("an element lies in too many groups, or there are too many of them");
    items_[{type.dimension, group}].push_back({entity, {nodes[0], nodes[1], nodes[2]}});
  }
}

// ---- groups --------------------------------------------------------------------------------------

std::string MshBuilder::name_of(int dimension, std::int64_t group) const {
  auto const found = names_.find({dimension, group});
  return found == names_.end() || found->second.empty() ? std::to_string(group) : found->second;
}

/// Index of the one volume group of a tet.
int MshBuilder::volume_name(int entity, Groups const& groups) {
  if (last_volume_.index >= 0 && last_volume_.entity == entity && last_volume_.groups == groups)
    return last_volume_.index;
  std::vector<std::string> names; // of its physical volumes, each once
  for (auto const g : groups) names.push_back(name_of(3, g));
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  if (names.size() > 1)
    scan_.refuse(fmt::format("volume {} belongs to the physical volumes '{}', '{}': a tet has one material, "
                             "so physical volumes must not overlap",
                             entity, names[0], names[1]));
  std::string const name = names.empty() ? "default" : names[0];
  int const index = group_named(3, mesh_.volume_groups, name);
  last_volume_ = {entity, groups, index};
  return index;
}

/// Index of the group of a name, made when first met: two physical groups of one name and dimension are
/// one.
template <class Group>
int MshBuilder::group_named(int dimension, std::vector<Group>& groups, std::string const& name) {
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

FaceGroup& MshBuilder::face_group(std::string const& name) {
  return mesh_.face_groups[static_cast<std::size_t>(group_named(2, mesh_.face_groups, name))];
}
LineGroup& MshBuilder::line_group(std::string const& name) {
  return mesh_.line_groups[static_cast<std::size_t>(group_named(1, mesh_.line_groups, name))];
}
PointGroup& MshBuilder::point_group(std::string const& name) {
  return mesh_.point_groups[static_cast<std::size_t>(group_named(0, mesh_.point_groups, name))];
}

/// Tets volume by volume, and their groups in that order.
void MshBuilder::sort_tets() {
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

void MshBuilder::make_groups() {
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
void MshBuilder::keep_empty_names() {
  for (auto const& [key, name] : names_) {
    if (name.empty()) continue;
    if (key.first == 3) group_named(3, mesh_.volume_groups, name);
    if (key.first == 2) face_group(name);
    if (key.first == 1) line_group(name);
    if (key.first == 0) point_group(name);
  }
}

Mesh MshBuilder::finish() {
  if (mesh_.tets.empty()) scan_.refuse("the mesh has no tets");
  sort_tets();
  make_groups();
  keep_empty_names();
  return std::move(mesh_);
}

} // namespace fissura::mesh
