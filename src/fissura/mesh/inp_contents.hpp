#pragma once
// What an .inp file says of its mesh, by the numbers of the file, before anything is looked up.
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

/// All of it. Throws core::InputError for what cannot be.
struct Contents {
  std::string file;     ///< stands in messages
  std::size_t size = 0; ///< of the file [bytes]
  std::vector<Node> nodes;
  std::vector<Element> elements;
  Sets node_sets, element_sets;
  std::vector<Surface> surfaces;
  std::vector<Section> sections;

  [[noreturn]] void refuse(int line, std::string message) const;
  /// Refuses the next one of `count` things, each of which should take some bytes of the file.
  void bound(std::size_t count, std::size_t bytes_each, int line, char const* what) const;
};

/// At most so many characters of a text from the file, for a message.
std::string shown(std::string const& text);

} // namespace fissura::mesh::inp
