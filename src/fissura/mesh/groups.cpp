#include "fissura/mesh/groups.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "fissura/core/text.hpp"

namespace fissura::mesh {

namespace {

std::string const& name_of(std::string const& volume_group) {
  return volume_group;
}
template <class Group> std::string const& name_of(Group const& group) {
  return group.name;
}

/// Calls visit(the groups of a dimension).
template <class Visit> void with_groups(Mesh const& m, int dimension, Visit visit) {
  switch (dimension) {
  case 0:
    return visit(m.point_groups);
  case 1:
    return visit(m.line_groups);
  case 2:
    return visit(m.face_groups);
  default:
    return visit(m.volume_groups);
  }
}

int group_of_own_name(Mesh const& m, int dimension, std::string const& name) {
  int found = -1;
  with_groups(m, dimension, [&](auto const& groups) {
    for (std::size_t i = 0; i < groups.size() && found < 0; ++i)
      if (name_of(groups[i]) == name) found = static_cast<int>(i);
  });
  return found;
}

[[noreturn]] void refuse_ambiguous(GroupAlias const& alias, core::Place const& place) {
  std::vector<std::string> names;
  for (auto const& g : alias.groups) names.push_back(fmt::format("\"{}\"", g));
  throw core::InputError(
      place,
      fmt::format("the name '{}' stands for several {} groups of the mesh: write one of {}", alias.name,
                  kinds_of_groups[static_cast<std::size_t>(alias.dimension)], core::joined(names, ", ")));
}

TetSet const* tet_set(Mesh const& m, std::string const& name) {
  for (auto const& set : m.tet_sets)
    if (set.name == name) return &set;
  return nullptr;
}

bool is_own_name(Mesh const& m, int dimension, std::string const& name) {
  return group_of_own_name(m, dimension, name) >= 0 || (dimension == 3 && tet_set(m, name));
}

/// The own names of what a name stands for.
std::vector<std::string> own_names(Mesh const& m, int dimension, std::string const& name,
                                   core::Place const& place) {
  if (is_own_name(m, dimension, name)) return {name};
  for (auto const& alias : m.aliases) {
    if (alias.dimension != dimension || alias.name != name) continue;
    if (alias.is_ambiguous) refuse_ambiguous(alias, place);
    return alias.groups;
  }
  return {};
}

/// The name behind the kind of its dimension, or "".
std::string without_kind(int dimension, std::string const& name) {
  auto const kind = kinds_of_groups[static_cast<std::size_t>(dimension)];
  bool const has_kind = name.size() > kind.size() + 1 && name.starts_with(kind) && name[kind.size()] == ':';
  return has_kind ? name.substr(kind.size() + 1) : std::string();
}

/// "Instance.set" of a group that is simply called "set", "PhysicalVolume1" of one that is called "1".
bool is_longer_form(GroupAlias const& alias) {
  return alias.groups.size() == 1 && alias.name.ends_with(alias.groups.front());
}

/// As own_names, of a name that may have a kind before it.
std::vector<std::string> all_own_names(Mesh const& m, int dimension, std::string const& name,
                                       core::Place const& place) {
  auto found = own_names(m, dimension, name, place);
  if (auto const rest = without_kind(dimension, name); found.empty() && !rest.empty())
    found = own_names(m, dimension, rest, place);
  return found;
}

} // namespace

std::vector<int> groups_named(Mesh const& m, int dimension, std::string const& name,
                              core::Place const& place) {
  std::vector<int> found;
  for (auto const& own : all_own_names(m, dimension, name, place)) {
    int const i = group_of_own_name(m, dimension, own);
    if (i < 0) return {}; // a set of tets
    found.push_back(i);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<int> tets_named(Mesh const& m, std::string const& name, core::Place const& place) {
  std::vector<char> wanted(m.volume_groups.size(), 0), chosen(m.tets.size(), 0);
  for (auto const& own : all_own_names(m, 3, name, place)) {
    if (int const i = group_of_own_name(m, 3, own); i >= 0)
      wanted[static_cast<std::size_t>(i)] = 1;
    else if (auto const* set = tet_set(m, own))
      for (int const t : set->tets) chosen[static_cast<std::size_t>(t)] = 1;
  }
  std::vector<int> tets;
  for (std::size_t t = 0; t < m.tets.size(); ++t)
    if (chosen[t] || wanted[static_cast<std::size_t>(m.tet_group[t])]) tets.push_back(static_cast<int>(t));
  return tets;
}

std::vector<std::string> names_of_groups(Mesh const& m, int dimension) {
  std::vector<std::string> names;
  with_groups(m, dimension, [&](auto const& groups) {
    for (auto const& g : groups) names.push_back(name_of(g));
  });
  if (dimension == 3)
    for (auto const& set : m.tet_sets) names.push_back(set.name);
  for (auto const& alias : m.aliases)
    if (alias.dimension == dimension && !alias.is_ambiguous && !is_longer_form(alias))
      names.push_back(alias.name);
  return names;
}

LineGroup curve_named(Mesh const& m, std::string const& name, core::Place const& place) {
  LineGroup all{name, {}};
  for (int const i : groups_named(m, 1, name, place)) {
    auto const& segments = m.line_groups[static_cast<std::size_t>(i)].segments;
    all.segments.insert(all.segments.end(), segments.begin(), segments.end());
  }
  return all;
}

} // namespace fissura::mesh
