#include "fissura/mesh/inp_mesh.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/renumber.hpp"

namespace fissura::mesh::inp {

namespace {

/// Corners of the sides S1 ... S4 of a C3D4.
constexpr std::array<std::array<int, 3>, 4> side_corners{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};

class Builder {
 public:
  explicit Builder(Contents of_file) : contents(std::move(of_file)) {}

  Mesh build() {
    sort_by_id(contents.nodes, "node");
    sort_by_id(contents.elements, "element");
    for (auto& e : contents.elements) connect(e);
    resolve_all(contents.node_sets, contents.nodes, "node");
    resolve_all(contents.element_sets, contents.elements, "element");
    Mesh m;
    for (auto const& n : contents.nodes) m.points.push_back(n.x);
    add_tets(m);
    add_groups(m);
    add_surfaces(m);
    drop_unused_points(m);
    return m;
  }

 private:
  template <class Item> void sort_by_id(std::vector<Item>& items, char const* what) const {
    std::stable_sort(items.begin(), items.end(), [](auto const& a, auto const& b) { return a.id < b.id; });
    for (std::size_t i = 1; i < items.size(); ++i)
      if (items[i].id == items[i - 1].id)
        contents.refuse(items[i].line,
                        fmt::format("{} {} stands already in line {}", what, items[i].id, items[i - 1].line));
  }

  /// First index whose number is not below id.
  template <class Item> static std::size_t lower(std::vector<Item> const& items, long id) {
    auto const found =
        std::lower_bound(items.begin(), items.end(), id, [](auto const& a, long b) { return a.id < b; });
    return static_cast<std::size_t>(found - items.begin());
  }

  /// Room for `count` members more, without holding more than half of it in vain while it grows.
  void make_room(std::vector<int>& in, std::size_t count) {
    contents.bound(members / members_per_entry, bytes_per_entry, 0, "members of sets");
    members += count;
    if (in.size() + count > in.capacity()) in.reserve(std::max(in.size() + count, in.size() + in.size() / 2));
  }

  /// Adds what one entry stands for, as indices into `items`. A range counts what exists in it, as in Abaqus.
  template <class Item>
  void resolve(Entry const& e, std::vector<Item> const& items, Sets const& sets, char const* what,
               std::vector<int>& to) {
    if (e.set >= 0) {
      auto const& other = sets.list[static_cast<std::size_t>(e.set)].members;
      make_room(to, other.size());
      to.insert(to.end(), other.begin(), other.end());
      return;
    }
    std::size_t const from = lower(items, e.first), end = lower(items, long{e.last} + 1);
    if (e.first == e.last && from == end)
      contents.refuse(e.line, fmt::format("there is no {} {}", what, e.first));
    if (from >= end) return;
    make_room(to, std::min(end - from, static_cast<std::size_t>((e.last - e.first) / e.step) + 1));
    for (std::size_t i = from; i < end; ++i)
      if ((items[i].id - e.first) % e.step == 0) to.push_back(static_cast<int>(i));
  }

  template <class Item> void resolve_all(Sets& sets, std::vector<Item> const& items, char const* what) {
    for (auto& set : sets.list) {
      for (auto const& e : set.entries) resolve(e, items, sets, what, set.members);
      std::sort(set.members.begin(), set.members.end());
      set.members.erase(std::unique(set.members.begin(), set.members.end()), set.members.end());
    }
  }

  void connect(Element& e) const {
    int const corners = e.kind == Kind::tet ? 4 : e.kind == Kind::triangle ? 3 : 2;
    for (int k = 0; k < corners; ++k) {
      std::size_t const i = lower(contents.nodes, e.nodes[k]);
      if (i == contents.nodes.size() || contents.nodes[i].id != e.nodes[k])
        contents.refuse(e.line,
                        fmt::format("element {} names node {}, which is not in the file", e.id, e.nodes[k]));
      e.nodes[k] = static_cast<int>(i);
    }
  }

  void add_tets(Mesh& m) {
    auto const group = volume_groups(m);
    for (std::size_t i = 0; i < contents.elements.size(); ++i) {
      auto const& e = contents.elements[i];
      if (e.kind != Kind::tet) continue;
      m.tets.push_back(e.nodes);
      if (geometry::volume(corners(m, static_cast<int>(m.tets.size()) - 1)) < 0)
        std::swap(m.tets.back()[0], m.tets.back()[1]);
      m.tet_group.push_back(group[i]);
      m.input_id.push_back(e.id);
    }
    if (m.tets.empty()) contents.refuse(0, "the file has no tets: no elements of type C3D4");
  }

  bool has_tets(Set const& set) const {
    return std::any_of(set.members.begin(), set.members.end(), [&](int i) {
      return contents.elements[static_cast<std::size_t>(i)].kind == Kind::tet;
    });
  }

  /// Per element the index of its volume group; groups are made in the order of the file.
  std::vector<int> volume_groups(Mesh& m) const {
    std::vector<int> group(contents.elements.size(), -1);
    std::vector<char> level(contents.elements.size(), 0);
    char now = 1;
    if (!contents.sections.empty()) {
      for (auto const& s : contents.sections) {
        Set const* set = contents.element_sets.find(s.set);
        if (!set)
          contents.refuse(s.line,
                          fmt::format("*SOLID SECTION: there is no element set \"{}\"", shown(s.set)));
        if (has_tets(*set)) claim(m, *set, now, group, level, s.line);
      }
    } else {
      for (auto const origin : {Origin::set_keyword, Origin::element_line}) {
        for (auto const& set : contents.element_sets.list)
          if (set.origin == origin && has_tets(set)) claim(m, set, now, group, level, 0);
        ++now;
      }
    }
    int rest = -1;
    for (std::size_t i = 0; i < contents.elements.size(); ++i) {
      if (contents.elements[i].kind != Kind::tet || group[i] >= 0) continue;
      if (rest < 0) rest = static_cast<int>(m.volume_groups.size()), m.volume_groups.emplace_back("default");
      group[i] = rest;
    }
    return group;
  }

  /// Gives the tets of a set to it, unless an earlier level has done so.
  void claim(Mesh& m, Set const& set, char now, std::vector<int>& group, std::vector<char>& level,
             int line) const {
    int mine = -1;
    for (int const member : set.members) {
      auto const i = static_cast<std::size_t>(member);
      if (contents.elements[i].kind != Kind::tet || (level[i] != 0 && level[i] != now)) continue;
      if (mine < 0) mine = group_index(m, set.name);
      if (level[i] == now && group[i] != mine)
        contents.refuse(
            line > 0 ? line : contents.elements[i].line,
            fmt::format(
                "tet {} is in the element sets \"{}\" and \"{}\": a tet has one material; name the sets of "
                "the materials in *SOLID SECTION, ELSET=...",
                contents.elements[i].id, m.volume_groups[static_cast<std::size_t>(group[i])], set.name));
      group[i] = mine, level[i] = now;
    }
  }

  static int group_index(Mesh& m, std::string const& name) {
    auto const found = std::find(m.volume_groups.begin(), m.volume_groups.end(), name);
    int const index = static_cast<int>(found - m.volume_groups.begin());
    if (found == m.volume_groups.end()) m.volume_groups.push_back(name);
    return index;
  }

  void add_groups(Mesh& m) {
    for (auto const& set : contents.element_sets.list) {
      LineGroup lines{set.name, {}};
      FaceGroup faces{set.name, {}};
      for (int const i : set.members) {
        auto const& e = contents.elements[static_cast<std::size_t>(i)];
        if (e.kind == Kind::line) lines.segments.push_back({e.nodes[0], e.nodes[1]});
        if (e.kind == Kind::triangle) faces.triangles.push_back({e.nodes[0], e.nodes[1], e.nodes[2]});
      }
      if (!lines.segments.empty()) m.line_groups.push_back(std::move(lines));
      if (!faces.triangles.empty()) m.face_groups.push_back(std::move(faces));
    }
    for (auto& set : contents.node_sets.list) m.point_groups.push_back({set.name, std::move(set.members)});
  }

  void add_surfaces(Mesh& m) {
    for (auto const& surface : contents.surfaces) {
      FaceGroup group{surface.name, {}};
      for (auto const& side : surface.sides) {
        std::vector<int> of;
        resolve(side.elements, contents.elements, contents.element_sets, "element", of);
        for (int const i : of) {
          auto const& e = contents.elements[static_cast<std::size_t>(i)];
          if (e.kind != Kind::tet)
            contents.refuse(side.elements.line,
                            fmt::format("element {} has no side S{}: it is no tet", e.id, side.face));
          auto const& c = side_corners[static_cast<std::size_t>(side.face - 1)];
          group.triangles.push_back({e.nodes[c[0]], e.nodes[c[1]], e.nodes[c[2]]});
        }
      }
      m.face_groups.push_back(std::move(group));
    }
  }

  Contents contents;
  std::size_t members = 0; ///< of all sets
};

} // namespace

Mesh make_mesh(Contents contents) {
  return Builder(std::move(contents)).build();
}

} // namespace fissura::mesh::inp
