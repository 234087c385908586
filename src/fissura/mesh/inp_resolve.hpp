#pragma once
// From the numbers of an .inp file to indices.
#include <vector>

#include "fissura/mesh/inp_contents.hpp"

namespace fissura::mesh::inp {

class Resolver {
 public:
  explicit Resolver(Contents& of_file) : contents(of_file) {}

  /// Sorts the nodes and elements of a part by their numbers, and looks up what elements and sets name.
  void resolve(Scope& part);
  /// The sets of the assembly; what instance i has is counted from node_start[i] and element_start[i].
  /// Numbers of the assembly's own are reference points and have no indices.
  void resolve_assembly(std::vector<int> const& node_start, std::vector<int> const& element_start);

  /// What entries of a part or, after resolve_assembly, of the assembly stand for: indices, ascending.
  std::vector<int> nodes_of(Scope const& scope, std::vector<Entry> const& entries);
  std::vector<int> elements_of(Scope const& scope, Entry const& entry);

 private:
  void add_nodes(Scope const& scope, Entry const& e, std::vector<int>& to);
  void add_elements(Scope const& scope, Entry const& e, std::vector<int>& to);
  void make_room(std::vector<int>& in, std::size_t count, int line);
  template <class Item>
  void add_range(Entry const& e, std::vector<Item> const& items, char const* what, std::vector<int>& to);
  void connect(Element& e, Scope const& part) const;

  Contents& contents;
  std::size_t members = 0; ///< of all sets
  std::vector<int> const *node_start = nullptr, *element_start = nullptr;
};

} // namespace fissura::mesh::inp
