#include "fissura/mesh/inp_volumes.hpp"

#include <algorithm>

#include <fmt/core.h>

namespace fissura::mesh::inp {

namespace {

class Claims {
 public:
  Claims(Contents const& of_file, Scope const& of_part) : contents(of_file), part(of_part) {
    volumes.of_element.assign(part.elements.size(), -1);
    for (auto const& set : part.element_sets.list) tets.push_back(tets_in(set));
  }

  Volumes take() {
    part.sections.empty() ? take_sets() : take_sections();
    return std::move(volumes);
  }

 private:
  bool is_tet(int element) const {
    return part.elements[static_cast<std::size_t>(element)].kind == Kind::tet;
  }
  Set const& set(int s) const { return part.element_sets.list[static_cast<std::size_t>(s)]; }

  std::size_t tets_in(Set const& of) const {
    return static_cast<std::size_t>(
        std::count_if(of.members.begin(), of.members.end(), [&](int e) { return is_tet(e); }));
  }
  std::size_t free_tets_in(Set const& of) const {
    return static_cast<std::size_t>(std::count_if(of.members.begin(), of.members.end(), [&](int e) {
      return is_tet(e) && volumes.of_element[static_cast<std::size_t>(e)] < 0;
    }));
  }

  void claim(int s, int line) {
    int const mine = static_cast<int>(volumes.sets.size());
    for (int const e : set(s).members) {
      if (!is_tet(e)) continue;
      int& owner = volumes.of_element[static_cast<std::size_t>(e)];
      if (owner >= 0) refuse_two(e, volumes.sets[static_cast<std::size_t>(owner)], s, line);
      owner = mine;
    }
    volumes.sets.push_back(s);
  }

  [[noreturn]] void refuse_two(int element, int a, int b, int line) const {
    auto const& e = part.elements[static_cast<std::size_t>(element)];
    contents.refuse(
        line > 0 ? line : e.line,
        fmt::format("tet {} is in the element sets \"{}\" and \"{}\": a tet has one material; name the "
                    "sets of the materials in *SOLID SECTION, ELSET=...",
                    e.id, shown(set(std::min(a, b)).name), shown(set(std::max(a, b)).name)));
  }

  void take_sections() {
    for (auto const& section : part.sections) {
      int const s = part.element_sets.find(section.set);
      if (s < 0)
        contents.refuse(section.line,
                        fmt::format("*SOLID SECTION: there is no element set \"{}\"", shown(section.set)));
      bool const again = std::find(volumes.sets.begin(), volumes.sets.end(), s) != volumes.sets.end();
      if (!again && tets[static_cast<std::size_t>(s)] > 0) claim(s, section.line);
    }
  }

  /// Whether claimed groups make up the set exactly.
  bool is_union(int s) const {
    if (free_tets_in(set(s)) > 0) return false;
    std::vector<int> groups;
    for (int const e : set(s).members)
      if (is_tet(e)) groups.push_back(volumes.of_element[static_cast<std::size_t>(e)]);
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    std::size_t sum = 0;
    for (int const g : groups)
      sum += tets[static_cast<std::size_t>(volumes.sets[static_cast<std::size_t>(g)])];
    return sum == tets[static_cast<std::size_t>(s)];
  }

  std::vector<int> sets_with_tets(Origin origin) const {
    std::vector<std::pair<std::size_t, int>> found;
    for (int s = 0; s < static_cast<int>(part.element_sets.list.size()); ++s)
      if (set(s).origin == origin)
        if (auto const count = tets[static_cast<std::size_t>(s)]; count > 0) found.emplace_back(count, s);
    std::sort(found.begin(), found.end());
    std::vector<int> sets;
    for (auto const& f : found) sets.push_back(f.second);
    return sets;
  }

  void take_sets() {
    for (int const s : sets_with_tets(Origin::set_keyword))
      if (!is_union(s)) claim(s, 0);
    for (int const s : sets_with_tets(Origin::element_line))
      if (free_tets_in(set(s)) == tets[static_cast<std::size_t>(s)]) claim(s, 0);
    sort_groups();
  }

  /// In the order of the file: first those of *ELSETs, then those of *ELEMENT lines.
  void sort_groups() {
    auto const before = [&](int a, int b) {
      bool const a_late = set(a).origin == Origin::element_line,
                 b_late = set(b).origin == Origin::element_line;
      return a_late != b_late ? b_late : a < b;
    };
    auto sorted = volumes.sets;
    std::sort(sorted.begin(), sorted.end(), before);
    for (int& v : volumes.of_element) {
      if (v < 0) continue;
      int const s = volumes.sets[static_cast<std::size_t>(v)];
      v = static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), s, before) - sorted.begin());
    }
    volumes.sets = std::move(sorted);
  }

  Contents const& contents;
  Scope const& part;
  std::vector<std::size_t> tets; ///< per element set
  Volumes volumes;
};

} // namespace

Volumes volumes_of(Contents const& contents, Scope const& part) {
  return Claims(contents, part).take();
}

} // namespace fissura::mesh::inp
