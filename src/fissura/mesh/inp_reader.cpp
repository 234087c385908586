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
#include "fissura/mesh/inp_mesh.hpp"

namespace fissura::mesh {

namespace {

namespace fs = std::filesystem;
using namespace inp;

constexpr std::uintmax_t largest_file = std::uintmax_t{2} << 30U;
constexpr std::size_t longest_line = 1 << 16; ///< characters
class Reader {
 public:
  Reader(std::string const& file, double unit_) : unit(unit_) { contents.file = file; }

  Mesh read(std::string_view text) {
    contents.size = text.size();
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
    return inp::make_mesh(std::move(contents));
  }

 private:
  using Action = void (Reader::*)(InpLine const& keyword, InpLine const& data);

  void refuse_long_lines(std::string_view text) const {
    int number = 1;
    for (std::size_t from = 0; from < text.size(); ++number) {
      std::size_t const end = std::min(text.find('\n', from), text.size());
      if (end - from > longest_line)
        contents.refuse(number, fmt::format("a line of more than {} characters", longest_line));
      from = end + 1;
    }
  }
  Set& named(Sets& sets, std::string const& name, Origin origin, int line) const {
    if (sets.list.size() >= most_sets && !sets.find(name))
      contents.refuse(line, fmt::format("more than {} sets", most_sets));
    return sets.named(name, origin);
  }

  // ---- keywords -------------------------------------------------------------------------------

  /// What to do with the data lines of a keyword; null: nothing.
  Action action(InpLine const& k) {
    if (k.name == "PART" && ++parts > 1)
      contents.refuse(k.number,
                      "a second *PART: a mesh file has one part, or none (write a flat input file)");
    if (k.name == "ASSEMBLY") in_assembly = true;
    if (k.name == "END ASSEMBLY") in_assembly = false;
    if (k.name == "INSTANCE") return &Reader::refuse_move;
    for (char const* other : {"INCLUDE", "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY"})
      if (k.name == other)
        contents.refuse(
            k.number,
            fmt::format("*{} is not known: all nodes and elements must stand in the file itself", other));
    if (k.name == "NODE") return node_keyword(k);
    if (k.name == "ELEMENT") return element_keyword(k);
    if (k.name == "NSET" || k.name == "ELSET") return set_keyword(k);
    if (k.name == "SURFACE") return surface_keyword(k);
    if (k.name == "SOLID SECTION")
      if (auto const* set = k.parameter("ELSET")) contents.sections.push_back({*set, k.number});
    return nullptr;
  }

  void refuse_move(InpLine const& k, InpLine const& data) {
    if (k.parameter("LIBRARY") || !data.fields.empty())
      contents.refuse(data.number, "a moved *INSTANCE is not known: write the nodes where they are");
  }

  Action node_keyword(InpLine const& k) {
    if (in_assembly) return nullptr; // reference points
    if (auto const* system = k.parameter("SYSTEM"); system && in_capitals(*system) != "R")
      contents.refuse(k.number, "*NODE with SYSTEM: only rectangular coordinates are known");
    node_set = k.parameter("NSET");
    if (node_set) named(contents.node_sets, *node_set, Origin::element_line, k.number);
    return &Reader::take_node;
  }

  Action element_keyword(InpLine const& k) {
    auto const* type = k.parameter("TYPE");
    if (!type) contents.refuse(k.number, "*ELEMENT without TYPE");
    std::string const name = in_capitals(*type);
    if (name == "C3D4")
      element_kind = Kind::tet;
    else if (name == "T3D2" || name == "B31")
      element_kind = Kind::line;
    else if (name == "S3" || name == "STRI3" || name == "CPS3" || name == "CPE3" || name == "M3D3" ||
             name == "SFM3D3")
      element_kind = Kind::triangle;
    else
      contents.refuse(
          k.number,
          fmt::format("elements of type {}: only C3D4 (tetrahedra), T3D2 (bars) and three-node triangles "
                      "are known; mesh the concrete with linear tetrahedra",
                      name));
    element_set = k.parameter("ELSET");
    if (element_set) named(contents.element_sets, *element_set, Origin::element_line, k.number);
    return &Reader::take_element;
  }

  Action set_keyword(InpLine const& k) {
    if (in_assembly && !k.parameter("INSTANCE")) return nullptr; // of reference points
    auto const* name = k.parameter(k.name);
    if (!name || name->empty())
      contents.refuse(k.number, fmt::format("*{0} needs a name: *{0}, {0}=name", k.name));
    named(k.name == "NSET" ? contents.node_sets : contents.element_sets, *name, Origin::set_keyword,
          k.number);
    return &Reader::take_members;
  }

  Action surface_keyword(InpLine const& k) {
    auto const* type = k.parameter("TYPE");
    if (type && in_capitals(*type) != "ELEMENT") return nullptr; // of contents.nodes, or analytical
    auto const* name = k.parameter("NAME");
    if (!name || name->empty()) contents.refuse(k.number, "*SURFACE needs a name: *SURFACE, NAME=name");
    if (contents.surfaces.size() >= most_sets)
      contents.refuse(k.number, fmt::format("more than {} surfaces", most_sets));
    contents.surfaces.push_back({*name, {}});
    return &Reader::take_side;
  }

  // ---- data -----------------------------------------------------------------------------------

  int whole(InpLine const& line, std::size_t i) const {
    auto const& text = line.fields[i];
    int value = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 1)
      contents.refuse(line.number, fmt::format("\"{}\" where a number from 1 is expected", shown(text)));
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
      contents.refuse(line.number,
                      fmt::format("\"{}\" where a coordinate is expected", shown(line.fields[i])));
    return value;
  }
  void take_node(InpLine const&, InpLine const& d) {
    if (d.fields.size() > 4)
      contents.refuse(
          d.number, fmt::format("a node has a number and three coordinates, not {} values", d.fields.size()));
    int const id = whole(d, 0);
    contents.bound(contents.nodes.size(), bytes_per_node, d.number, "nodes");
    contents.nodes.push_back({id, d.number, unit * Vec3{real(d, 1), real(d, 2), real(d, 3)}});
    if (node_set) append(contents.node_sets.named(*node_set, Origin::element_line), id, d.number);
  }

  void take_element(InpLine const&, InpLine const& d) {
    std::size_t const corners = element_kind == Kind::tet ? 4 : element_kind == Kind::triangle ? 3 : 2;
    if (d.fields.size() != corners + 1)
      contents.refuse(d.number, fmt::format("an element of {} nodes has {} numbers, not {}", corners,
                                            corners + 1, d.fields.size()));
    Element e;
    e.id = whole(d, 0), e.kind = element_kind, e.line = d.number;
    for (std::size_t k = 0; k < corners; ++k) e.nodes[k] = whole(d, k + 1);
    contents.bound(contents.elements.size(), bytes_per_element, d.number, "elements");
    contents.elements.push_back(e);
    if (element_set) append(contents.element_sets.named(*element_set, Origin::element_line), e.id, d.number);
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
    contents.bound(entries++, bytes_per_entry, e.line, "entries of sets");
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
      contents.refuse(d.number,
                      fmt::format("there is no {} set \"{}\" above",
                                  &sets == &contents.node_sets ? "node" : "element", shown(d.fields[i])));
    return {0, 0, 1, static_cast<int>(set - sets.list.data()), d.number};
  }

  void take_members(InpLine const& k, InpLine const& d) {
    auto& sets = k.name == "NSET" ? contents.node_sets : contents.element_sets;
    auto& set = sets.named(*k.parameter(k.name), Origin::set_keyword);
    if (!k.parameter("GENERATE")) {
      auto const own = static_cast<std::size_t>(&set - sets.list.data());
      for (std::size_t i = 0; i < d.fields.size(); ++i)
        if (!d.fields[i].empty()) add_entry(set.entries, entry(d, i, sets, own));
      return;
    }
    if (d.fields.size() < 2 || d.fields.size() > 3)
      contents.refuse(d.number, "GENERATE expects: first, last, step");
    add_entry(set.entries, {whole(d, 0), whole(d, 1), d.fields.size() == 3 ? whole(d, 2) : 1, -1, d.number});
  }

  void take_side(InpLine const&, InpLine const& d) {
    if (d.fields.empty()) return;
    std::string const label = d.fields.size() == 2 ? in_capitals(d.fields[1]) : "";
    if (label.size() != 2 || label[0] != 'S' || label[1] < '1' || label[1] > '4')
      contents.refuse(d.number,
                      "a line of a *SURFACE is an element or a set of them, and a side S1, S2, S3 or S4");
    contents.bound(entries++, bytes_per_entry, d.number, "sides of surfaces");
    contents.surfaces.back().sides.push_back(
        {entry(d, 0, contents.element_sets, contents.element_sets.list.size()), label[1] - '0'});
  }

  double unit;
  Contents contents;
  // What the data lines of the present keyword belong to.
  Kind element_kind = Kind::tet;
  std::string const *node_set = nullptr, *element_set = nullptr;
  int parts = 0;
  bool in_assembly = false;
  std::size_t entries = 0; ///< of all sets
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
