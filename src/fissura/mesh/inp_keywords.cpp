#include "fissura/mesh/inp_keywords.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/core.h>

namespace fissura::mesh::inp {

namespace {

constexpr std::size_t most_named = 24;

struct Word {
  std::string_view keyword, why;
};

/// They change what nodes and elements there are, or where.
constexpr std::array<Word, 12> refused{{
    {"INCLUDE", "all nodes and elements must stand in the file itself"},
    {"NGEN", "all nodes and elements must stand in the file itself"},
    {"NFILL", "all nodes and elements must stand in the file itself"},
    {"NCOPY", "all nodes and elements must stand in the file itself"},
    {"NMAP", "all nodes and elements must stand in the file itself"},
    {"ELGEN", "all nodes and elements must stand in the file itself"},
    {"ELCOPY", "all nodes and elements must stand in the file itself"},
    {"IMPORT", "all nodes and elements must stand in the file itself"},
    {"SYMMETRIC MODEL GENERATION", "all nodes and elements must stand in the file itself"},
    {"IMPERFECTION", "it moves nodes; write them where they are"},
    {"PARAMETER", "write numbers instead of <parameters>"},
    {"SUBMODEL", "the motion of its boundary comes from another job; give it as [[motion]]"},
}};

/// The model would behave otherwise with them.
constexpr std::array<Word, 17> missed{{
    {"TIE", "bodies that it ties are joined here only where they share nodes: mesh them as one"},
    {"MPC", "say what it does with [[support]] or [[motion]]"},
    {"EQUATION", "say what it does with [[support]] or [[motion]]"},
    {"COUPLING", "give the motion or the force to the nodes or faces themselves"},
    {"KINEMATIC COUPLING", "give the motion to the nodes themselves"},
    {"DISTRIBUTING COUPLING", "give the force to the nodes or faces themselves"},
    {"SHELL TO SOLID COUPLING", "only the tets are a body"},
    {"RIGID BODY", "use [[plane]] or [[impactor]], or a stiff [[concrete]] with joints = false"},
    {"CYCLIC SYMMETRY MODEL", "mesh the whole body, or use [[support]] on planes of symmetry"},
    {"PRE-TENSION SECTION", "use `initial_strain` of [[bar]]"},
    {"REBAR", "the steel that it describes is missing: use [[bar]]"},
    {"REBAR LAYER", "the steel that it describes is missing: use [[bar]]"},
    {"NONSTRUCTURAL MASS", "its mass is missing: use `density` of [[concrete]]"},
    {"MODEL CHANGE", "no element is taken away or added during a run"},
    {"INITIAL CONDITIONS",
     "the body starts at rest and free of stress; see [[initial_velocity]] and `initial_strain` of [[bar]]"},
    {"RELEASE", "bars have no hinges"},
    {"JOINT", "only tets are joined"},
}};

template <std::size_t count>
Word const* find(std::array<Word, count> const& words, std::string const& keyword) {
  auto const found =
      std::find_if(words.begin(), words.end(), [&](Word const& w) { return w.keyword == keyword; });
  return found == words.end() ? nullptr : &*found;
}

} // namespace

void OtherKeywords::take(InpLine const& k, Contents& contents) {
  if (auto const* word = find(refused, k.name))
    contents.refuse(k.number, fmt::format("*{} is not known: {}", word->keyword, word->why));
  if (find(missed, k.name)) {
    doubtful.emplace(k.name, k.number);
    return;
  }
  for (char const* silent : {"HEADING", "PREPRINT", "EMBEDDED ELEMENT", "END STEP"})
    if (k.name == silent) return;
  if (left.size() > most_named || std::find(left.begin(), left.end(), k.name) != left.end()) return;
  left.push_back(k.name);
}

void OtherKeywords::report(Contents& contents) const {
  for (auto const& [keyword, line] : doubtful)
    contents.doubts.push_back(fmt::format("{}:{}: *{} is not obeyed: {}", contents.file, line, keyword,
                                          find(missed, keyword)->why));
  if (left.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < left.size() && i < most_named; ++i)
    list += fmt::format("{}*{}", i > 0 ? ", " : "", shown(left[i]));
  contents.notes.push_back(fmt::format("{}: not read, since the case says it: {}{}", contents.file, list,
                                       left.size() > most_named ? ", ..." : ""));
}

} // namespace fissura::mesh::inp
