#include "fissura/mesh/inp_names.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/core.h>

namespace fissura::mesh::inp {

namespace {

class Naming {
 public:
  Naming(std::vector<Candidate>& all_, Contents const& of_file) : all(all_), contents(of_file) {}

  std::vector<GroupAlias> give() {
    std::map<std::pair<int, std::string>, std::vector<std::size_t>> of_name;
    for (std::size_t i = 0; i < all.size(); ++i)
      of_name[{all[i].dimension, in_capitals(all[i].name)}].push_back(i);
    for (auto& [key, same] : of_name) name(drop_repeated(same));
    refuse_twice();
    return std::move(aliases);
  }

 private:
  std::string const& scope_of(Candidate const& c) const {
    return c.instance >= 0 ? contents.instances[static_cast<std::size_t>(c.instance)].name
                           : contents.assembly.name;
  }
  std::string long_name(Candidate const& c) const {
    auto const& scope = scope_of(c);
    return scope.empty() ? c.name : scope + "." + c.name;
  }
  /// Instances with a mesh of their own count as copies of their part.
  std::size_t part_of(Candidate const& c) const {
    if (c.instance < 0) return contents.parts.size();
    auto const part = contents.instances[static_cast<std::size_t>(c.instance)].part;
    auto const found = contents.part_of.find(in_capitals(contents.parts[part].name));
    return found == contents.part_of.end() ? part : found->second;
  }

  /// One scope may call a set and a surface alike if they are the same.
  std::vector<std::size_t> drop_repeated(std::vector<std::size_t> const& same) const {
    std::vector<std::size_t> kept;
    std::map<int, std::size_t> of_scope;
    for (auto const i : same) {
      auto const [first, fresh] = of_scope.emplace(all[i].instance, i);
      if (fresh)
        kept.push_back(i);
      else if (all[first->second].items != all[i].items)
        contents.refuse(all[i].line,
                        fmt::format("\"{}\" is also the name of another set or surface, in line {}: "
                                    "rename one of them",
                                    shown(all[i].name), all[first->second].line));
    }
    return kept;
  }

  void name(std::vector<std::size_t> const& same) {
    auto& first = all[same.front()];
    if (same.size() == 1) {
      first.own_name = first.name;
      if (auto const full = long_name(first); full != first.name)
        aliases.push_back({full, first.dimension, {first.name}, false});
      return;
    }
    std::map<std::size_t, std::vector<std::string>> by_part;
    std::vector<std::string> names;
    std::set<std::string> spellings;
    bool are_equal = true;
    for (auto const i : same) {
      auto& c = all[i];
      c.own_name = long_name(c);
      names.push_back(c.own_name);
      spellings.insert(c.name);
      by_part[part_of(c)].push_back(c.own_name);
      are_equal = are_equal && c.items == first.items;
    }
    auto const apart = names_of_parts(first, by_part);
    for (auto const& plain : spellings) {
      if (are_equal)
        aliases.push_back({plain, first.dimension, {names.front()}, false});
      else if (by_part.size() == 1)
        aliases.push_back({plain, first.dimension, names, false});
      else
        aliases.push_back({plain, first.dimension, apart, true});
    }
  }

  /// "Part.set" for the copies in several instances of one part; returns the names that tell the parts apart.
  std::vector<std::string> names_of_parts(Candidate const& c,
                                          std::map<std::size_t, std::vector<std::string>> const& by_part) {
    std::vector<std::string> apart;
    for (auto const& [part, names] : by_part) {
      bool const is_one = names.size() == 1 || part >= contents.parts.size();
      std::string const& part_name = is_one ? names.front() : contents.parts[part].name;
      if (is_one || contents.instance_of.contains(in_capitals(part_name))) {
        apart.insert(apart.end(), names.begin(), names.end());
        continue;
      }
      aliases.push_back({part_name + "." + c.name, c.dimension, names, false});
      apart.push_back(aliases.back().name);
    }
    return apart;
  }

  /// A set may have been called "instance.set" by its author.
  void refuse_twice() const {
    std::map<std::pair<int, std::string>, std::size_t> taken;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].own_name.empty()) continue;
      if (!taken.emplace(std::pair{all[i].dimension, all[i].own_name}, i).second)
        contents.refuse(all[i].line, fmt::format("\"{}\" names two sets of the file: rename one of them",
                                                 shown(all[i].own_name)));
    }
  }

  std::vector<Candidate>& all;
  Contents const& contents;
  std::vector<GroupAlias> aliases;
};

} // namespace

std::vector<GroupAlias> give_names(std::vector<Candidate>& candidates, Contents const& contents) {
  return Naming(candidates, contents).give();
}

} // namespace fissura::mesh::inp
