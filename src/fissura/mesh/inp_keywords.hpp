#pragma once
// What becomes of the keywords of an .inp file that hold no mesh.
#include <map>
#include <string>
#include <vector>

#include "fissura/mesh/inp_contents.hpp"

namespace fissura::mesh::inp {

/// Collects the keywords that are not read, to name them once. Those that would give another mesh or another
/// position of it are refused, with the cure; those whose effect may be missed become doubts.
class OtherKeywords {
 public:
  void take(InpLine const& keyword, Contents& contents);
  /// Writes the note. Call at the end of the file.
  void report(Contents& contents) const;

 private:
  std::vector<std::string> left;       ///< in the order of the file, each once
  std::map<std::string, int> doubtful; ///< with the line of the first
};

} // namespace fissura::mesh::inp
