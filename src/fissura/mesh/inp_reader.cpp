#include "fissura/mesh/inp_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/mesh/inp_scanner.hpp"
#include "fissura/mesh/renumber.hpp"

namespace fissura::mesh {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_file = std::uintmax_t{2} << 30U;
constexpr std::size_t longest_line = 1 << 16; ///< characters
constexpr std::size_t most_sets = 100'000;
/// What is kept of a file stays in proportion to its size: so many, and one more for every few bytes. (Files
/// that people make have a node in 20 bytes or more, an element in 16, an entry of a set in 8.)
constexpr std::size_t always_allowed = 500'000;
constexpr std::size_t bytes_per_node = 16, bytes_per_element = 12, bytes_per_entry = 8;
constexpr std::size_t members_per_entry = 4; ///< of all sets together: sets overlap

enum class Kind { tet, triangle, line };

struct Element {
  int id = 0;
  Kind kind = Kind::tet;
  std::array<int, 4> nodes{}; ///< numbers in the file, then indices of points
  int line = 0;               ///< of the file
};

/// One entry of a set: a number, a range or a set defined before.
struct Entry {
  int first = 0, last = 0, step = 1;
  int set = -1; ///< its place in Sets::list; -1: a range
  int line = 0;
};
struct Section {
  std::string set;
  int line = 0;
};
enum class Origin { element_line, set_keyword };
struct Set {
  std::string name;
  Origin origin = Origin::set_keyword;
  std::vector<Entry> entries;
  std::vector<int> members; ///< indices, ascending
};
/// Sets by their names in capitals, and in the order of the file.
struct Sets {
  std::map<std::string, std::size_t> place;
  std::vector<Set> list;

  Set& named(std::string const& name, Origin origin) {
    auto const [found, fresh] = place.emplace(in_capitals(name), list.size());
    if (fresh) list.push_back({name, origin, {}, {}});
    auto& set = list[found->second];
    if (origin == Origin::set_keyword) set.origin = origin;
    return set;
  }
  Set const* find(std::string const& name) const {
    auto const found = place.find(in_capitals(name));
    return found == place.end() ? nullptr : &list[found->second];
  }
};

/// A side of an element or of all elements of a set: *SURFACE.
struct Side {
  Entry elements;
  int face = 0; ///< 1 ... 4 as in S1 ... S4
};
struct Surface {
  std::string name;
  std::vector<Side> sides;
};

/// Corners of the sides S1 ... S4 of a C3D4.
constexpr std::array<std::array<int, 3>, 4> side_corners{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};

class Reader {
 public:
  Reader(std::string const& file_, double unit_) : file(file_), unit(unit_) {}

  Mesh read(std::string_view text) {
    size = text.size();
    refuse_long_lines(text);
    InpScanner scanner(text);
    InpLine line;
    bool more = scanner.next(line);
    while (more) {
      if (!line.keyword) {
        more = scanner.next(line); // data of a keyword that is left alone
        continue;
      }
      InpLine const keyword = line;
      auto const take = action(keyword);
      auto const data =
          take == &Reader::take_element ? InpScanner::Data::goes_on : InpScanner::Data::one_line;
      more = scanner.next(line, data);
      for (; more && !line.keyword; more = scanner.next(line, data))
        if (take) (this->*take)(keyword, line);
    }
    return finish();
  }

 private:
  using Action = void (Reader::*)(InpLine const& keyword, InpLine const& data);

  [[noreturn]] void refuse(int line, std::string message) const {
    throw core::InputError({file, line, 0}, std::move(message));
  }

  void refuse_long_lines(std::string_view text) const {
    int number = 1;
    for (std::size_t from = 0; from < text.size(); ++number) {
      std::size_t const end = std::min(text.find('\n', from), text.size());
      if (end - from > longest_line)
        refuse(number, fmt::format("a line of more than {} characters", longest_line));
      from = end + 1;
    }
  }
  /// Refuses the next one of `count` things, each of which should take some bytes of the file.
  void bound(std::size_t count, std::size_t bytes_each, int line, char const* what) const {
    if (count >= always_allowed + size / bytes_each)
      refuse(line, fmt::format("more {} than a file of this size describes", what));
  }
  Set& named(Sets& sets, std::string const& name, Origin origin, int line) const {
    if (sets.list.size() >= most_sets && !sets.find(name))
      refuse(line, fmt::format("more than {} sets", most_sets));
    return sets.named(name, origin);
  }

  // ---- keywords -------------------------------------------------------------------------------

  /// What to do with the data lines of a keyword; null: nothing.
  Action action(InpLine const& k) {
    if (k.name == "PART" && ++parts > 1)
      refuse(k.number, "a second *PART: a mesh file has one part, or none (write a flat input file)");
    if (k.name == "ASSEMBLY") in_assembly = true;
    if (k.name == "END ASSEMBLY") in_assembly = false;
    if (k.name == "INSTANCE") return &Reader::refuse_move;
    for (char const* other : {"INCLUDE", "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY"})
      if (k.name == other)
        refuse(k.number,
               fmt::format("*{} is not known: all nodes and elements must stand in the file itself", other));
    if (k.name == "NODE") return node_keyword(k);
    if (k.name == "ELEMENT") return element_keyword(k);
    if (k.name == "NSET" || k.name == "ELSET") return set_keyword(k);
    if (k.name == "SURFACE") return surface_keyword(k);
    if (k.name == "SOLID SECTION")
      if (auto const* set = k.parameter("ELSET")) sections.push_back({*set, k.number});
    return nullptr;
  }

  void refuse_move(InpLine const& k, InpLine const& data) {
    if (k.parameter("LIBRARY") || !data.fields.empty())
      refuse(data.number, "a moved *INSTANCE is not known: write the nodes where they are");
  }

  Action node_keyword(InpLine const& k) {
    if (in_assembly) return nullptr; // reference points
    if (auto const* system = k.parameter("SYSTEM"); system && in_capitals(*system) != "R")
      refuse(k.number, "*NODE with SYSTEM: only rectangular coordinates are known");
    node_set = k.parameter("NSET");
    if (node_set) named(node_sets, *node_set, Origin::element_line, k.number);
    return &Reader::take_node;
  }

  Action element_keyword(InpLine const& k) {
    auto const* type = k.parameter("TYPE");
    if (!type) refuse(k.number, "*ELEMENT without TYPE");
    std::string const name = in_capitals(*type);
    if (name == "C3D4")
      element_kind = Kind::tet;
    else if (name == "T3D2" || name == "B31")
      element_kind = Kind::line;
    else if (name == "S3" || name == "STRI3" || name == "CPS3" || name == "CPE3" || name == "M3D3" ||
             name == "SFM3D3")
      element_kind = Kind::triangle;
    else
      refuse(k.number,
             fmt::format("elements of type {}: only C3D4 (tetrahedra), T3D2 (bars) and three-node triangles "
                         "are known; mesh the concrete with linear tetrahedra",
                         name));
    element_set = k.parameter("ELSET");
    if (element_set) named(element_sets, *element_set, Origin::element_line, k.number);
    return &Reader::take_element;
  }

  Action set_keyword(InpLine const& k) {
    if (in_assembly && !k.parameter("INSTANCE")) return nullptr; // of reference points
    auto const* name = k.parameter(k.name);
    if (!name || name->empty()) refuse(k.number, fmt::format("*{0} needs a name: *{0}, {0}=name", k.name));
    named(k.name == "NSET" ? node_sets : element_sets, *name, Origin::set_keyword, k.number);
    return &Reader::take_members;
  }

  Action surface_keyword(InpLine const& k) {
    auto const* type = k.parameter("TYPE");
    if (type && in_capitals(*type) != "ELEMENT") return nullptr; // of nodes, or analytical
    auto const* name = k.parameter("NAME");
    if (!name || name->empty()) refuse(k.number, "*SURFACE needs a name: *SURFACE, NAME=name");
    if (surfaces.size() >= most_sets) refuse(k.number, fmt::format("more than {} surfaces", most_sets));
    surfaces.push_back({*name, {}});
    return &Reader::take_side;
  }

  // ---- data -----------------------------------------------------------------------------------

  int whole(InpLine const& line, std::size_t i) const {
    auto const& text = line.fields[i];
    int value = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 1)
      refuse(line.number, fmt::format("\"{}\" where a number from 1 is expected", shown(text)));
    return value;
  }
  double real(InpLine const& line, std::size_t i) const {
    if (i >= line.fields.size() || line.fields[i].empty()) return 0;
    std::string text = line.fields[i];
    if (text.front() == '+') text.erase(0, 1);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    double value = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      refuse(line.number, fmt::format("\"{}\" where a coordinate is expected", shown(line.fields[i])));
    return value;
  }
  static std::string shown(std::string const& text) {
    return text.size() <= 40 ? text : text.substr(0, 40) + "...";
  }

  void take_node(InpLine const&, InpLine const& d) {
    if (d.fields.size() > 4)
      refuse(d.number,
             fmt::format("a node has a number and three coordinates, not {} values", d.fields.size()));
    int const id = whole(d, 0);
    bound(nodes.size(), bytes_per_node, d.number, "nodes");
    nodes.push_back({id, d.number, unit * Vec3{real(d, 1), real(d, 2), real(d, 3)}});
    if (node_set) append(node_sets.named(*node_set, Origin::element_line), id, d.number);
  }

  void take_element(InpLine const&, InpLine const& d) {
    std::size_t const corners = element_kind == Kind::tet ? 4 : element_kind == Kind::triangle ? 3 : 2;
    if (d.fields.size() != corners + 1)
      refuse(d.number, fmt::format("an element of {} nodes has {} numbers, not {}", corners, corners + 1,
                                   d.fields.size()));
    Element e;
    e.id = whole(d, 0), e.kind = element_kind, e.line = d.number;
    for (std::size_t k = 0; k < corners; ++k) e.nodes[k] = whole(d, k + 1);
    bound(elements.size(), bytes_per_element, d.number, "elements");
    elements.push_back(e);
    if (element_set) append(element_sets.named(*element_set, Origin::element_line), e.id, d.number);
  }

  /// Numbers that follow each other make one entry.
  void append(Set& set, int id, int line) {
    if (!set.entries.empty()) {
      auto& last = set.entries.back();
      if (last.set < 0 && last.step == 1 && long{last.last} + 1 == id) {
        last.last = id;
        return;
      }
    }
    add_entry(set.entries, {id, id, 1, -1, line});
  }
  void add_entry(std::vector<Entry>& to, Entry const& e) {
    bound(entries++, bytes_per_entry, e.line, "entries of sets");
    to.push_back(e);
  }

  /// A number, or a set among the first `above` ones.
  Entry entry(InpLine const& d, std::size_t i, Sets const& sets, std::size_t above) const {
    bool const number =
        !d.fields[i].empty() && d.fields[i].find_first_not_of("0123456789") == std::string::npos;
    if (number) {
      int const id = whole(d, i);
      return {id, id, 1, -1, d.number};
    }
    Set const* set = sets.find(d.fields[i]);
    if (!set || static_cast<std::size_t>(set - sets.list.data()) >= above)
      refuse(d.number, fmt::format("there is no {} set \"{}\" above",
                                   &sets == &node_sets ? "node" : "element", shown(d.fields[i])));
    return {0, 0, 1, static_cast<int>(set - sets.list.data()), d.number};
  }

  void take_members(InpLine const& k, InpLine const& d) {
    auto& sets = k.name == "NSET" ? node_sets : element_sets;
    auto& set = sets.named(*k.parameter(k.name), Origin::set_keyword);
    if (!k.parameter("GENERATE")) {
      auto const own = static_cast<std::size_t>(&set - sets.list.data());
      for (std::size_t i = 0; i < d.fields.size(); ++i)
        if (!d.fields[i].empty()) add_entry(set.entries, entry(d, i, sets, own));
      return;
    }
    if (d.fields.size() < 2 || d.fields.size() > 3) refuse(d.number, "GENERATE expects: first, last, step");
    add_entry(set.entries, {whole(d, 0), whole(d, 1), d.fields.size() == 3 ? whole(d, 2) : 1, -1, d.number});
  }

  void take_side(InpLine const&, InpLine const& d) {
    if (d.fields.empty()) return;
    std::string const label = d.fields.size() == 2 ? in_capitals(d.fields[1]) : "";
    if (label.size() != 2 || label[0] != 'S' || label[1] < '1' || label[1] > '4')
      refuse(d.number, "a line of a *SURFACE is an element or a set of them, and a side S1, S2, S3 or S4");
    bound(entries++, bytes_per_entry, d.number, "sides of surfaces");
    surfaces.back().sides.push_back({entry(d, 0, element_sets, element_sets.list.size()), label[1] - '0'});
  }

  // ---- at the end -----------------------------------------------------------------------------

  struct Node {
    int id = 0, line = 0;
    Vec3 x;
  };

  template <class Item> void sort_by_id(std::vector<Item>& items, char const* what) const {
    std::stable_sort(items.begin(), items.end(), [](auto const& a, auto const& b) { return a.id < b.id; });
    for (std::size_t i = 1; i < items.size(); ++i)
      if (items[i].id == items[i - 1].id)
        refuse(items[i].line,
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
    bound(members / members_per_entry, bytes_per_entry, 0, "members of sets");
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
    if (e.first == e.last && from == end) refuse(e.line, fmt::format("there is no {} {}", what, e.first));
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

  Mesh finish() {
    sort_by_id(nodes, "node");
    sort_by_id(elements, "element");
    for (auto& e : elements) connect(e);
    resolve_all(node_sets, nodes, "node");
    resolve_all(element_sets, elements, "element");
    Mesh m;
    for (auto const& n : nodes) m.points.push_back(n.x);
    add_tets(m);
    add_groups(m);
    add_surfaces(m);
    drop_unused_points(m);
    return m;
  }

  void connect(Element& e) const {
    int const corners = e.kind == Kind::tet ? 4 : e.kind == Kind::triangle ? 3 : 2;
    for (int k = 0; k < corners; ++k) {
      std::size_t const i = lower(nodes, e.nodes[k]);
      if (i == nodes.size() || nodes[i].id != e.nodes[k])
        refuse(e.line, fmt::format("element {} names node {}, which is not in the file", e.id, e.nodes[k]));
      e.nodes[k] = static_cast<int>(i);
    }
  }

  void add_tets(Mesh& m) {
    auto const group = volume_groups(m);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      auto const& e = elements[i];
      if (e.kind != Kind::tet) continue;
      m.tets.push_back(e.nodes);
      if (geometry::volume(corners(m, static_cast<int>(m.tets.size()) - 1)) < 0)
        std::swap(m.tets.back()[0], m.tets.back()[1]);
      m.tet_group.push_back(group[i]);
      m.input_id.push_back(e.id);
    }
    if (m.tets.empty()) refuse(0, "the file has no tets: no elements of type C3D4");
  }

  bool has_tets(Set const& set) const {
    return std::any_of(set.members.begin(), set.members.end(),
                       [&](int i) { return elements[static_cast<std::size_t>(i)].kind == Kind::tet; });
  }

  /// Per element the index of its volume group; groups are made in the order of the file.
  std::vector<int> volume_groups(Mesh& m) const {
    std::vector<int> group(elements.size(), -1);
    std::vector<char> level(elements.size(), 0);
    char now = 1;
    if (!sections.empty()) {
      for (auto const& s : sections) {
        Set const* set = element_sets.find(s.set);
        if (!set) refuse(s.line, fmt::format("*SOLID SECTION: there is no element set \"{}\"", shown(s.set)));
        if (has_tets(*set)) claim(m, *set, now, group, level, s.line);
      }
    } else {
      for (auto const origin : {Origin::set_keyword, Origin::element_line}) {
        for (auto const& set : element_sets.list)
          if (set.origin == origin && has_tets(set)) claim(m, set, now, group, level, 0);
        ++now;
      }
    }
    int rest = -1;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (elements[i].kind != Kind::tet || group[i] >= 0) continue;
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
      if (elements[i].kind != Kind::tet || (level[i] != 0 && level[i] != now)) continue;
      if (mine < 0) mine = group_index(m, set.name);
      if (level[i] == now && group[i] != mine)
        refuse(
            line > 0 ? line : elements[i].line,
            fmt::format(
                "tet {} is in the element sets \"{}\" and \"{}\": a tet has one material; name the sets of "
                "the materials in *SOLID SECTION, ELSET=...",
                elements[i].id, m.volume_groups[static_cast<std::size_t>(group[i])], set.name));
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
    for (auto const& set : element_sets.list) {
      LineGroup lines{set.name, {}};
      FaceGroup faces{set.name, {}};
      for (int const i : set.members) {
        auto const& e = elements[static_cast<std::size_t>(i)];
        if (e.kind == Kind::line) lines.segments.push_back({e.nodes[0], e.nodes[1]});
        if (e.kind == Kind::triangle) faces.triangles.push_back({e.nodes[0], e.nodes[1], e.nodes[2]});
      }
      if (!lines.segments.empty()) m.line_groups.push_back(std::move(lines));
      if (!faces.triangles.empty()) m.face_groups.push_back(std::move(faces));
    }
    for (auto& set : node_sets.list) m.point_groups.push_back({set.name, std::move(set.members)});
  }

  void add_surfaces(Mesh& m) {
    for (auto const& surface : surfaces) {
      FaceGroup group{surface.name, {}};
      for (auto const& side : surface.sides) {
        std::vector<int> of;
        resolve(side.elements, elements, element_sets, "element", of);
        for (int const i : of) {
          auto const& e = elements[static_cast<std::size_t>(i)];
          if (e.kind != Kind::tet)
            refuse(side.elements.line,
                   fmt::format("element {} has no side S{}: it is no tet", e.id, side.face));
          auto const& c = side_corners[static_cast<std::size_t>(side.face - 1)];
          group.triangles.push_back({e.nodes[c[0]], e.nodes[c[1]], e.nodes[c[2]]});
        }
      }
      m.face_groups.push_back(std::move(group));
    }
  }

  std::string const& file; ///< stands in messages
  double unit;
  std::vector<Node> nodes;
  std::vector<Element> elements;
  Sets node_sets, element_sets;
  std::vector<Surface> surfaces;
  std::vector<Section> sections;
  // What the data lines of the present keyword belong to.
  Kind element_kind = Kind::tet;
  std::string const *node_set = nullptr, *element_set = nullptr;
  int parts = 0;
  bool in_assembly = false;
  std::size_t size = 0;                 ///< of the file [bytes]
  std::size_t entries = 0, members = 0; ///< of all sets
};

std::string read_text(fs::path const& path) {
  auto const refuse = [&](char const* why) { throw core::InputError({path.string(), 0, 0}, why); };
  std::error_code error;
  if (!fs::exists(path, error)) refuse("no such mesh file");
  if (!fs::is_regular_file(path, error)) refuse("the mesh file is not a regular file");
  if (fs::file_size(path, error) > largest_file) refuse("the mesh file is larger than 2 GiB");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || !text) refuse("the mesh file cannot be read (is it empty, or not readable?)");
  return std::move(text).str();
}

} // namespace

Mesh parse_inp(std::string_view text, std::string const& file, double length_unit) {
  if (!(length_unit > 0))
    throw core::InputError({file, 0, 0}, fmt::format("length unit {:g} m: it must be positive", length_unit));
  return Reader(file, length_unit).read(text);
}

Mesh read_inp(fs::path const& path, double length_unit) {
  return parse_inp(read_text(path), path.string(), length_unit);
}

} // namespace fissura::mesh
