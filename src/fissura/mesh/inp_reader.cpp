#include "fissura/mesh/inp_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>

#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/mesh/inp_element_types.hpp"
#include "fissura/mesh/inp_keywords.hpp"
#include "fissura/mesh/inp_mesh.hpp"

namespace fissura::mesh {

namespace {

namespace fs = std::filesystem;
using namespace inp;

constexpr std::uintmax_t largest_file = std::uintmax_t{2} << 30U;
constexpr std::size_t longest_line = 1 << 16; ///< characters

/// Without the quotation marks that names with blanks stand in.
std::string unquoted(std::string const& text) {
  return text.size() > 1 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2)
                                                                      : text;
}
bool is_number(std::string const& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

class Reader {
 public:
  Reader(std::string const& file, double unit_, std::size_t copies_allowed) : unit(unit_) {
    contents.file = file;
    contents.copies_allowed = copies_allowed;
  }

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
      bool const is_element = take == &Reader::take_element || take == &Reader::take_other;
      auto const data = is_element ? InpScanner::Data::goes_on : InpScanner::Data::one_line;
      lines_of_data = 0;
      more = scanner.next(line, data);
      for (; more && !line.keyword; more = scanner.next(line, data), ++lines_of_data)
        if (take) (this->*take)(keyword, line);
    }
    note_left_out();
    others.report(contents);
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

  // ---- scopes ---------------------------------------------------------------------------------

  bool in_instance() const { return instance >= 0; }

  /// Where the mesh keywords of this place write to. An instance that has some of its own gets a copy of its
  /// part.
  Scope& here(int line) {
    if (in_assembly && !in_instance()) return contents.assembly;
    if (!in_instance()) return contents.parts[part];
    auto& mine = contents.instances[static_cast<std::size_t>(instance)];
    if (!mine.has_own_mesh) {
      Scope own = contents.parts[mine.part];
      contents.copy(size_of(own), line);
      mine.has_own_mesh = true;
      mine.part = contents.parts.size();
      contents.parts.push_back(std::move(own));
    }
    return contents.parts[mine.part];
  }
  static std::size_t size_of(Scope const& s) {
    std::size_t count = s.nodes.size() + s.elements.size() + s.surfaces.size() + s.sections.size();
    for (auto const* sets : {&s.node_sets, &s.element_sets})
      for (auto const& set : sets->list) count += copies_per_set + set.entries.size();
    for (auto const& surface : s.surfaces) count += surface.sides.size() + surface.nodes.size();
    return count;
  }

  void begin_part(InpLine const& k) {
    auto const* name = k.parameter("NAME");
    if (!name || name->empty()) contents.refuse(k.number, "*PART needs a name: *PART, NAME=name");
    if (in_assembly) contents.refuse(k.number, "*PART inside *ASSEMBLY: parts stand before it");
    if (contents.parts.size() > most_sets)
      contents.refuse(k.number, fmt::format("more than {} parts", most_sets));
    auto const [at, fresh] = contents.part_of.emplace(in_capitals(*name), contents.parts.size());
    if (!fresh)
      contents.refuse(k.number, fmt::format("part \"{}\" stands already in line {}", shown(*name),
                                            contents.parts[at->second].line));
    part = contents.parts.size();
    contents.parts.emplace_back();
    contents.parts.back().name = *name;
    contents.parts.back().line = k.number;
  }

  void begin_assembly(InpLine const& k) {
    in_assembly = contents.has_assembly = true;
    part = 0;
    if (auto const* name = k.parameter("NAME")) contents.assembly.name = *name;
    if (contents.assembly.name.empty()) contents.assembly.name = "Assembly";
  }

  Action begin_instance(InpLine const& k) {
    for (char const* other : {"LIBRARY", "INSTANCE"})
      if (k.parameter(other))
        contents.refuse(k.number,
                        fmt::format("*INSTANCE, {}: its mesh stands in the results of another job; write "
                                    "the input file with the mesh itself",
                                    other));
    auto const *name = k.parameter("NAME"), *of = k.parameter("PART");
    if (!name || name->empty() || !of)
      contents.refuse(k.number, "*INSTANCE needs a name and a part: *INSTANCE, NAME=name, PART=part");
    auto const found = contents.part_of.find(in_capitals(*of));
    if (found == contents.part_of.end())
      contents.refuse(k.number, fmt::format("*INSTANCE: there is no part \"{}\" above", shown(*of)));
    if (contents.instances.size() >= most_sets)
      contents.refuse(k.number, fmt::format("more than {} instances", most_sets));
    auto const [at, fresh] = contents.instance_of.emplace(in_capitals(*name), contents.instances.size());
    if (!fresh)
      contents.refuse(k.number, fmt::format("instance \"{}\" stands already in line {}", shown(*name),
                                            contents.instances[at->second].line));
    instance = static_cast<int>(contents.instances.size());
    contents.instances.emplace_back();
    auto& mine = contents.instances.back();
    mine.name = *name, mine.part = found->second, mine.line = k.number;
    return &Reader::take_position;
  }

  /// The first line moves an instance, the second one turns it.
  void take_position(InpLine const&, InpLine const& d) {
    auto& mine = contents.instances[static_cast<std::size_t>(instance)];
    auto const vector = [&](std::size_t i) { return Vec3{real(d, i), real(d, i + 1), real(d, i + 2)}; };
    if (lines_of_data == 0 && d.fields.size() <= 3) {
      mine.is_moved = true, mine.shift = unit * vector(0);
    } else if (lines_of_data == 1 && d.fields.size() == 7) {
      mine.is_turned = true, mine.turn = {unit * vector(0), unit * vector(3), real(d, 6)};
      if (!(norm(mine.turn.b - mine.turn.a) > 0))
        contents.refuse(d.number, "the two points of the axis of an instance are one");
    } else {
      contents.refuse(
          d.number,
          "an *INSTANCE has a line with its translation (x, y, z) and may have one with its rotation "
          "(two points of the axis, and the angle)");
    }
  }

  // ---- keywords -------------------------------------------------------------------------------

  Set& named(Sets& sets, std::string const& name, Origin origin, int line) const {
    if (sets.list.size() >= most_sets && sets.find(name) < 0)
      contents.refuse(line, fmt::format("more than {} sets", most_sets));
    return sets.named(name, origin, line);
  }

  /// What to do with the data lines of a keyword; null: nothing.
  Action action(InpLine const& k) {
    if (k.name == "PART") return begin_part(k), nullptr;
    if (k.name == "END PART") return part = 0, nullptr;
    if (k.name == "ASSEMBLY") return begin_assembly(k), nullptr;
    if (k.name == "END ASSEMBLY") return in_assembly = false, instance = -1, nullptr;
    if (k.name == "INSTANCE") return begin_instance(k);
    if (k.name == "END INSTANCE") return instance = -1, nullptr;
    if (k.name == "SYSTEM") return &Reader::refuse_system;
    if (k.name == "NODE" || k.name == "ELEMENT" || k.name == "NSET" || k.name == "ELSET" ||
        k.name == "SURFACE")
      if (k.parameter("INPUT"))
        contents.refuse(
            k.number,
            fmt::format("*{}, INPUT: all nodes and elements must stand in the file itself", k.name));
    if (k.name == "NODE") return node_keyword(k);
    if (k.name == "ELEMENT") return element_keyword(k);
    if (k.name == "NSET" || k.name == "ELSET") return set_keyword(k);
    if (k.name == "SURFACE") return surface_keyword(k);
    if (auto const* set = k.parameter("ELSET"); set && k.name == "SOLID SECTION") {
      here(k.number).sections.push_back({*set, k.number});
      return nullptr;
    }
    others.take(k, contents);
    return nullptr;
  }

  void refuse_system(InpLine const&, InpLine const& d) {
    contents.refuse(d.number, "*SYSTEM is not known: write the nodes in the coordinates of the whole model");
  }

  Action node_keyword(InpLine const& k) {
    if (in_assembly && !in_instance()) return nullptr; // reference points
    is_cylindrical = false;
    if (auto const* system = k.parameter("SYSTEM")) {
      std::string const letter = in_capitals(*system);
      if (letter != "R" && letter != "C")
        contents.refuse(k.number,
                        "*NODE with SYSTEM: only rectangular and cylindrical coordinates (R, C) are known");
      is_cylindrical = letter == "C";
    }
    auto const* set = k.parameter("NSET");
    own_set = set ? &named(here(k.number).node_sets, *set, Origin::element_line, k.number) : nullptr;
    scope = &here(k.number);
    return &Reader::take_node;
  }

  Action element_keyword(InpLine const& k) {
    auto const* type = k.parameter("TYPE");
    if (!type) contents.refuse(k.number, "*ELEMENT without TYPE");
    std::string const name = in_capitals(*type);
    auto const fate = fate_of(name);
    if (fate.fate == Fate::refused)
      contents.refuse(
          k.number,
          fmt::format(
              "elements of type {}: only C3D4 (tetrahedra), T3D2 or B31 (bars) and three-node triangles "
              "are known; mesh the concrete with linear tetrahedra and the bars with elements of two nodes",
              shown(name)));
    scope = &here(k.number);
    if (scope == &contents.assembly) {
      if (fate.kind == Kind::tet || fate.kind == Kind::line)
        contents.refuse(k.number,
                        fmt::format("elements of type {} at the level of the assembly: put them into a part",
                                    shown(name)));
      own_set = nullptr;
    } else {
      auto const* set = k.parameter("ELSET");
      own_set = set ? &named(scope->element_sets, *set, Origin::element_line, k.number) : nullptr;
    }
    element_kind = fate.kind;
    if (fate.fate == Fate::read) return &Reader::take_element;
    if (left_out.size() >= most_types && !left_out.contains(name))
      contents.refuse(k.number, fmt::format("more than {} types of elements", most_types));
    of_type = &left_out[name];
    return &Reader::take_other;
  }

  Action set_keyword(InpLine const& k) {
    auto const* name = k.parameter(k.name);
    if (!name || name->empty())
      contents.refuse(k.number, fmt::format("*{0} needs a name: *{0}, {0}=name", k.name));
    scope = &here(k.number);
    of_instance = instance_named(k);
    auto& sets = k.name == "NSET" ? scope->node_sets : scope->element_sets;
    own_set = &named(sets, *name, Origin::set_keyword, k.number);
    auto const* elements = k.parameter("ELSET");
    if (k.name == "NSET" && elements) {
      Entry e = set_entry(k.number, *elements, &Scope::element_sets, most_sets);
      e.is_nodes_of_elements = true;
      add_entry(own_set->entries, e);
      return nullptr;
    }
    return &Reader::take_members;
  }

  /// The INSTANCE of a set of the assembly, or -1.
  int instance_named(InpLine const& k) const {
    auto const* name = k.parameter("INSTANCE");
    if (!name) return -1;
    if (scope != &contents.assembly)
      contents.refuse(k.number,
                      fmt::format("*{}, INSTANCE=...: only sets of the assembly name an instance", k.name));
    auto const found = contents.instance_of.find(in_capitals(*name));
    if (found == contents.instance_of.end())
      contents.refuse(k.number, fmt::format("there is no instance \"{}\" above", shown(*name)));
    return static_cast<int>(found->second);
  }

  Action surface_keyword(InpLine const& k) {
    auto const *type = k.parameter("TYPE"), *name = k.parameter("NAME");
    if (!name || name->empty()) contents.refuse(k.number, "*SURFACE needs a name: *SURFACE, NAME=name");
    std::string const kind = type ? in_capitals(*type) : "ELEMENT";
    if ((kind != "ELEMENT" && kind != "NODE") || k.parameter("COMBINE")) {
      if (surfaces_left_out.size() < most_named) surfaces_left_out.push_back(shown(*name));
      return nullptr;
    }
    scope = &here(k.number);
    of_instance = -1;
    if (scope->surfaces.size() >= most_sets)
      contents.refuse(k.number, fmt::format("more than {} surfaces", most_sets));
    scope->surfaces.push_back({*name, k.number, {}, {}});
    return kind == "NODE" ? &Reader::take_surface_node : &Reader::take_side;
  }

  // ---- data -----------------------------------------------------------------------------------

  int whole(int line, std::string const& text) const {
    int value = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 1)
      contents.refuse(line, fmt::format("\"{}\" where a number from 1 is expected", shown(text)));
    return value;
  }
  int whole(InpLine const& line, std::size_t i) const { return whole(line.number, line.fields[i]); }
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
    if (d.fields.empty()) return;
    if (d.fields.size() > 4)
      contents.refuse(
          d.number, fmt::format("a node has a number and three coordinates, not {} values", d.fields.size()));
    int const id = whole(d, 0);
    contents.bound(nodes++, bytes_per_node, d.number, "nodes");
    Vec3 x{real(d, 1), real(d, 2), real(d, 3)};
    if (is_cylindrical) {
      double const angle = x.y * std::numbers::pi / 180;
      x = {x.x * std::cos(angle), x.x * std::sin(angle), x.z};
    }
    scope->nodes.push_back({id, d.number, unit * x});
    if (own_set) append(*own_set, id, d.number);
  }

  void take_element(InpLine const&, InpLine const& d) {
    if (d.fields.empty()) return;
    auto const corners = static_cast<std::size_t>(corners_of(element_kind));
    // A beam may name a node that gives its orientation.
    bool const has_one_more = element_kind == Kind::line && d.fields.size() == corners + 2;
    if (d.fields.size() != corners + 1 && !has_one_more)
      contents.refuse(d.number, fmt::format("an element of {} nodes has {} numbers, not {}", corners,
                                            corners + 1, d.fields.size()));
    Element e;
    e.id = whole(d, 0), e.kind = element_kind, e.line = d.number;
    for (std::size_t k = 0; k < corners; ++k) e.nodes[k] = whole(d, k + 1);
    add_element(e);
  }
  void take_other(InpLine const&, InpLine const& d) {
    if (d.fields.empty()) return;
    ++*of_type;
    Element e;
    e.kind = Kind::other, e.line = d.number;
    if (scope == &contents.assembly) return;
    e.id = whole(d, 0);
    add_element(e);
  }
  void add_element(Element const& e) {
    contents.bound(elements++, bytes_per_element, e.line, "elements");
    scope->elements.push_back(e);
    if (own_set) append(*own_set, e.id, e.line);
  }

  /// Numbers that follow each other make one entry.
  void append(Set& set, int id, int line) {
    if (!set.entries.empty()) {
      auto& last = set.entries.back();
      if (last.set < 0 && last.step == 1 && last.instance < 0 && long{last.last} + 1 == id) {
        last.last = id;
        return;
      }
    }
    add_entry(set.entries, {id, id, 1, -1, line, -1, false});
  }
  void add_entry(std::vector<Entry>& to, Entry const& e) {
    contents.bound(entries++, bytes_per_entry, e.line, "entries of sets");
    to.push_back(e);
  }

  /// What `text` names as a member: a number, or a set among the first `above` ones of its scope.
  Entry entry(int line, std::string const& text, Sets Scope::*sets, std::size_t above) const {
    if (!is_number(text)) return set_entry(line, unquoted(text), sets, above);
    int const id = whole(line, text);
    return {id, id, 1, -1, line, of_instance, false};
  }

  Entry set_entry(int line, std::string const& name, Sets Scope::*sets, std::size_t above) const {
    if (of_instance >= 0) return set_of_instance(line, name, of_instance, sets);
    if (int const own = (scope->*sets).find(name); own >= 0 && static_cast<std::size_t>(own) < above)
      return {0, 0, 1, own, line, -1, false};
    if (scope == &contents.assembly) return set_from_the_assembly(line, name, sets);
    refuse_no_set(line, name, sets);
  }
  [[noreturn]] void refuse_no_set(int line, std::string const& name, Sets Scope::*sets) const {
    contents.refuse(line, fmt::format("there is no {} set \"{}\" above",
                                      sets == &Scope::node_sets ? "node" : "element", shown(name)));
  }
  Entry set_of_instance(int line, std::string const& name, int of, Sets Scope::*sets) const {
    auto const& owner = contents.parts[contents.instances[static_cast<std::size_t>(of)].part];
    int const set = (owner.*sets).find(name);
    if (set < 0) refuse_no_set(line, name, sets);
    return {0, 0, 1, set, line, of, false};
  }

  /// "Instance.set", "Instance.number", or a set that only one instance has.
  Entry set_from_the_assembly(int line, std::string const& name, Sets Scope::*sets) const {
    for (auto dot = name.rfind('.'); dot != std::string::npos && dot > 0; dot = name.rfind('.', dot - 1)) {
      auto const found = contents.instance_of.find(in_capitals(name.substr(0, dot)));
      if (found == contents.instance_of.end()) continue;
      int const of = static_cast<int>(found->second);
      std::string const rest = unquoted(name.substr(dot + 1));
      if (!is_number(rest)) return set_of_instance(line, rest, of, sets);
      int const id = whole(line, rest);
      return {id, id, 1, -1, line, of, false};
    }
    int only = -1;
    for (std::size_t i = 0; i < contents.instances.size(); ++i) {
      if ((contents.parts[contents.instances[i].part].*sets).find(name) < 0) continue;
      if (only >= 0)
        contents.refuse(line,
                        fmt::format("several instances have a set \"{0}\": write \"{1}.{0}\" or \"{2}.{0}\"",
                                    shown(name), contents.instances[static_cast<std::size_t>(only)].name,
                                    contents.instances[i].name));
      only = static_cast<int>(i);
    }
    if (only < 0) refuse_no_set(line, name, sets);
    return set_of_instance(line, name, only, sets);
  }

  void take_members(InpLine const& k, InpLine const& d) {
    auto const sets = k.name == "NSET" ? &Scope::node_sets : &Scope::element_sets;
    if (!k.parameter("GENERATE")) {
      auto const own = static_cast<std::size_t>(own_set - (scope->*sets).list.data());
      for (auto const& field : d.fields)
        if (!field.empty()) add_entry(own_set->entries, entry(d.number, field, sets, own));
      return;
    }
    if (d.fields.size() < 2 || d.fields.size() > 3)
      contents.refuse(d.number, "GENERATE expects: first, last, step");
    add_entry(own_set->entries, {whole(d, 0), whole(d, 1), d.fields.size() == 3 ? whole(d, 2) : 1, -1,
                                 d.number, of_instance, false});
  }

  void take_side(InpLine const&, InpLine const& d) {
    if (d.fields.empty()) return;
    std::string const label = d.fields.size() == 2 ? in_capitals(d.fields[1]) : "";
    bool const is_side = label.size() == 2 && label[0] == 'S' && label[1] >= '1' && label[1] <= '4';
    bool const is_free = label.empty() || label == "SPOS" || label == "SNEG";
    if (d.fields.size() > 2 || (!is_side && !is_free))
      contents.refuse(d.number,
                      "a line of a *SURFACE is an element or a set of them, and a side S1, S2, S3 or S4");
    contents.bound(entries++, bytes_per_entry, d.number, "sides of surfaces");
    scope->surfaces.back().sides.push_back(
        {entry(d.number, d.fields[0], &Scope::element_sets, most_sets), is_side ? label[1] - '0' : 0});
  }
  void take_surface_node(InpLine const&, InpLine const& d) {
    if (d.fields.empty() || d.fields[0].empty()) return;
    add_entry(scope->surfaces.back().nodes, entry(d.number, d.fields[0], &Scope::node_sets, most_sets));
  }

  // ---- what was left out ------------------------------------------------------------------------

  void note_left_out() {
    std::string list;
    std::size_t named_types = 0;
    for (auto const& [type, count] : left_out) {
      if (count == 0 || named_types++ >= most_named) continue;
      list += fmt::format("{}{} element{} of type {}", list.empty() ? "" : ", ", count, count > 1 ? "s" : "",
                          shown(type));
    }
    if (!list.empty())
      contents.notes.push_back(fmt::format("{}: left out, since they are no body: {}{}", contents.file, list,
                                           named_types > most_named ? ", ..." : ""));
    list.clear();
    for (auto const& name : surfaces_left_out)
      list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", name);
    if (!list.empty())
      contents.notes.push_back(fmt::format("{}: left out: surface{} {}, not made of elements or nodes",
                                           contents.file, surfaces_left_out.size() > 1 ? "s" : "", list));
  }

  static constexpr std::size_t most_types = 1000, most_named = 24;

  double unit;
  Contents contents;
  OtherKeywords others;
  std::size_t part = 0;
  bool in_assembly = false;
  int instance = -1;
  // What the data lines of the present keyword belong to.
  Scope* scope = nullptr;
  Set* own_set = nullptr;
  Kind element_kind = Kind::tet;
  std::size_t* of_type = nullptr;
  bool is_cylindrical = false;
  int of_instance = -1, lines_of_data = 0;
  std::size_t nodes = 0, elements = 0, entries = 0; ///< of all scopes
  std::map<std::string, std::size_t> left_out;      ///< by type of element
  std::vector<std::string> surfaces_left_out;
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

Mesh parse_inp(std::string_view text, std::string const& file, double length_unit,
               std::size_t copies_allowed) {
  if (!(length_unit > 0))
    throw core::InputError({file, 0, 0}, fmt::format("length unit {:g} m: it must be positive", length_unit));
  return Reader(file, length_unit, copies_allowed).read(text);
}

Mesh read_inp(fs::path const& path, double length_unit) {
  return parse_inp(read_text(path), path.string(), length_unit, inp::most_copies);
}

} // namespace fissura::mesh
