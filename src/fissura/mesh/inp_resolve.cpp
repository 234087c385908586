#include "fissura/mesh/inp_resolve.hpp"

#include <algorithm>

#include <fmt/core.h>

namespace fissura::mesh::inp {

namespace {

template <class Item> void sort_by_id(Contents const& contents, std::vector<Item>& items, char const* what) {
  std::stable_sort(items.begin(), items.end(), [](auto const& a, auto const& b) { return a.id < b.id; });
  for (std::size_t i = 1; i < items.size(); ++i)
    if (items[i].id == items[i - 1].id)
      contents.refuse(items[i].line,
                      fmt::format("{} {} stands already in line {}", what, items[i].id, items[i - 1].line));
}

/// First index whose number is not below id.
template <class Item> std::size_t lower(std::vector<Item> const& items, long id) {
  auto const found =
      std::lower_bound(items.begin(), items.end(), id, [](auto const& a, long b) { return a.id < b; });
  return static_cast<std::size_t>(found - items.begin());
}

void sort_out(std::vector<int>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

void shift(std::vector<int>& to, std::size_t from, int by) {
  for (std::size_t i = from; i < to.size(); ++i) to[i] += by;
}

} // namespace

/// Room for `count` members more, without holding more than half of it in vain while it grows.
void Resolver::make_room(std::vector<int>& in, std::size_t count, int line) {
  contents.bound(members / members_per_entry, bytes_per_entry, line, "members of sets");
  members += count;
  if (in.size() + count > in.capacity()) in.reserve(std::max(in.size() + count, in.size() + in.size() / 2));
}

/// A range counts what exists in it, as in Abaqus.
template <class Item>
void Resolver::add_range(Entry const& e, std::vector<Item> const& items, char const* what,
                         std::vector<int>& to) {
  std::size_t const from = lower(items, e.first), end = lower(items, long{e.last} + 1);
  if (e.first == e.last && from == end)
    contents.refuse(e.line, fmt::format("there is no {} {}", what, e.first));
  if (from >= end) return;
  make_room(to, std::min(end - from, static_cast<std::size_t>((e.last - e.first) / e.step) + 1), e.line);
  for (std::size_t i = from; i < end; ++i)
    if ((items[i].id - e.first) % e.step == 0) to.push_back(static_cast<int>(i));
}

void Resolver::add_elements(Scope const& scope, Entry const& e, std::vector<int>& to) {
  bool const is_copied = e.instance >= 0;
  auto const i = static_cast<std::size_t>(std::max(e.instance, 0));
  Scope const& owner = is_copied ? contents.parts[contents.instances[i].part] : scope;
  std::size_t const from = to.size();
  if (e.set >= 0) {
    auto const& other = owner.element_sets.list[static_cast<std::size_t>(e.set)].members;
    make_room(to, other.size(), e.line);
    to.insert(to.end(), other.begin(), other.end());
  } else if (&owner != &contents.assembly) {
    add_range(e, owner.elements, "element", to);
  }
  if (is_copied) shift(to, from, (*element_start)[i]);
}

void Resolver::add_nodes(Scope const& scope, Entry const& e, std::vector<int>& to) {
  bool const is_copied = e.instance >= 0;
  auto const i = static_cast<std::size_t>(std::max(e.instance, 0));
  Scope const& owner = is_copied ? contents.parts[contents.instances[i].part] : scope;
  std::size_t const from = to.size();
  if (e.is_nodes_of_elements && &owner != &contents.assembly) {
    for (int const element : owner.element_sets.list[static_cast<std::size_t>(e.set)].members) {
      auto const& of = owner.elements[static_cast<std::size_t>(element)];
      auto const corners = corners_of(of.kind);
      make_room(to, static_cast<std::size_t>(corners), e.line);
      to.insert(to.end(), of.nodes.begin(), of.nodes.begin() + corners);
    }
  } else if (e.is_nodes_of_elements) {
    contents.refuse(e.line, "*NSET, ELSET=... of a set of the assembly: write instance.set");
  } else if (e.set >= 0) {
    auto const& other = owner.node_sets.list[static_cast<std::size_t>(e.set)].members;
    make_room(to, other.size(), e.line);
    to.insert(to.end(), other.begin(), other.end());
  } else if (&owner != &contents.assembly) {
    add_range(e, owner.nodes, "node", to);
  }
  if (is_copied) shift(to, from, (*node_start)[i]);
}

std::vector<int> Resolver::nodes_of(Scope const& scope, std::vector<Entry> const& entries) {
  std::vector<int> nodes;
  for (auto const& e : entries) add_nodes(scope, e, nodes);
  sort_out(nodes);
  return nodes;
}

std::vector<int> Resolver::elements_of(Scope const& scope, Entry const& entry) {
  std::vector<int> elements;
  add_elements(scope, entry, elements);
  return elements;
}

void Resolver::connect(Element& e, Scope const& part) const {
  for (int k = 0; k < corners_of(e.kind); ++k) {
    std::size_t const i = lower(part.nodes, e.nodes[k]);
    if (i == part.nodes.size() || part.nodes[i].id != e.nodes[k])
      contents.refuse(e.line, fmt::format("element {} names node {}, which is not in the {}", e.id,
                                          e.nodes[k], part.name.empty() ? "file" : "part"));
    e.nodes[k] = static_cast<int>(i);
  }
}

void Resolver::resolve(Scope& part) {
  sort_by_id(contents, part.nodes, "node");
  sort_by_id(contents, part.elements, "element");
  for (auto& e : part.elements) connect(e, part);
  for (auto& set : part.element_sets.list) {
    for (auto const& e : set.entries) add_elements(part, e, set.members);
    sort_out(set.members);
  }
  for (auto& set : part.node_sets.list) set.members = nodes_of(part, set.entries);
}

void Resolver::resolve_assembly(std::vector<int> const& nodes, std::vector<int> const& elements) {
  node_start = &nodes, element_start = &elements;
  auto& assembly = contents.assembly;
  for (auto& set : assembly.element_sets.list) {
    for (auto const& e : set.entries) add_elements(assembly, e, set.members);
    sort_out(set.members);
  }
  for (auto& set : assembly.node_sets.list) set.members = nodes_of(assembly, set.entries);
}

} // namespace fissura::mesh::inp
