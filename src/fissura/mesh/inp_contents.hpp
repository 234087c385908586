#pragma once
// What an .inp file says of its mesh, by the numbers of the file, before anything is looked up.
//
// Numbers and names hold within a scope: the file itself, a part, or the assembly. A flat file is one scope.
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "fissura/core/vec3.hpp"
#include "fissura/mesh/inp_scanner.hpp"

namespace fissura::mesh::inp {

constexpr std::size_t most_sets = 100'000;
/// What is kept of a file stays in proportion to its size: so many, and one more for every few bytes. (Files
/// that people make have a node in 20 bytes or more, an element in 16, an entry of a set in 8.)
constexpr std::size_t always_allowed = 500'000;
constexpr std::size_t bytes_per_node = 16, bytes_per_element = 12, bytes_per_entry = 8;
constexpr std::size_t members_per_entry = 4; ///< of all sets together: sets overlap

struct Node {
  int id = 0, line = 0;
  Vec3 x;
};

/// `other`: no body that this program knows; its number stays, since sets may name it.
enum class Kind { tet, triangle, line, other };
constexpr int corners_of(Kind kind) {
  return kind == Kind::tet ? 4 : kind == Kind::triangle ? 3 : kind == Kind::line ? 2 : 0;
}

struct Element {
  int id = 0;
  Kind kind = Kind::tet;
  std::array<int, 4> nodes{}; ///< numbers in the file, then indices of the scope's nodes
  int line = 0;               ///< of the file
};

/// One entry of a set: numbers, or another set.
struct Entry {
  int first = 0, last = 0, step = 1;
  int set = -1; ///< its place in the Sets::list of its scope; -1: numbers
  int line = 0;
  int instance = -1;                 ///< in the assembly: whose numbers or set; -1: the assembly's own
  bool is_nodes_of_elements = false; ///< in a set of nodes: `set` is one of elements
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
  int line = 0;
};
/// Sets by their names in capitals, and in the order of the file.
struct Sets {
  std::map<std::string, std::size_t> place;
  std::vector<Set> list;

  Set& named(std::string const& name, Origin origin, int line) {
    auto const [found, fresh] = place.emplace(in_capitals(name), list.size());
    if (fresh) list.push_back({name, origin, {}, {}, line});
    auto& set = list[found->second];
    if (origin == Origin::set_keyword) set.origin = origin;
    return set;
  }
  /// Place in the list, or -1.
  int find(std::string const& name) const {
    auto const found = place.find(in_capitals(name));
    return found == place.end() ? -1 : static_cast<int>(found->second);
  }
};

/// A side of an element or of all elements of a set: *SURFACE.
struct Side {
  Entry elements;
  int face = 0; ///< 1 ... 4 as in S1 ... S4; 0: those sides that no other tet shares
};
struct Surface {
  std::string name;
  int line = 0;
  std::vector<Side> sides;
  std::vector<Entry> nodes; ///< of a *SURFACE, TYPE=NODE
};

struct Scope {
  std::string name; ///< of the part, or of the assembly
  int line = 0;
  std::vector<Node> nodes;
  std::vector<Element> elements;
  Sets node_sets, element_sets;
  std::vector<Surface> surfaces;
  std::vector<Section> sections;

  bool is_empty() const { return nodes.empty() && elements.empty(); }
};

/// A turn by `angle` [degrees] about the axis from a to b.
struct Turn {
  Vec3 a, b;
  double angle = 0;
};
struct Instance {
  std::string name;
  std::size_t part = 0; ///< index into Contents::parts
  int line = 0;
  bool is_moved = false, is_turned = false;
  bool has_own_mesh = false;
  Vec3 shift; ///< [m], comes before the turn
  Turn turn;
};

/// What instances add to a file: at most so many nodes, elements and members of sets (and one more in 16 for
/// a set).
constexpr std::size_t most_copies = 50'000'000;
constexpr std::size_t copies_per_set = 16;

/// All of it. Throws core::InputError for what cannot be.
struct Contents {
  std::string file;     ///< stands in messages
  std::size_t size = 0; ///< of the file [bytes]
  std::size_t copies_allowed = most_copies;
  std::vector<Scope> parts = {Scope{}}; ///< the first one is the file itself
  std::vector<Instance> instances;
  Scope assembly;
  bool has_assembly = false;
  std::map<std::string, std::size_t> instance_of, part_of; ///< by names in capitals
  std::vector<std::string> notes, doubts;                  ///< for the log

  [[noreturn]] void refuse(int line, std::string message) const;
  /// Refuses the next one of `count` things, each of which should take some bytes of the file.
  void bound(std::size_t count, std::size_t bytes_each, int line, char const* what) const;
  /// Counts what an instance copies.
  void copy(std::size_t count, int line);

 private:
  std::size_t copied = 0;
};

/// At most so many characters of a text from the file, for a message.
std::string shown(std::string const& text);

} // namespace fissura::mesh::inp
