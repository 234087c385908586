#pragma once
// Names for the groups of an .inp file with several scopes.
//
// A set is called as in the file while nothing else of its dimension is: its long name, "Instance.set" or
// "Assembly.set", is one more. Otherwise each has its long name only, and the plain one stands for all of
// them where they are the copies of one part's set in its instances, and for nothing where they are different
// things.
#include <string>
#include <vector>

#include "fissura/mesh/inp_contents.hpp"
#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh::inp {

/// What may become a group.
struct Candidate {
  int dimension = 0;
  std::string name; ///< in the file
  int instance = -1;
  int line = 0;
  std::vector<int> items; ///< indices: of points; two or three of them for each segment or triangle; of tets
  int volume = -1;        ///< dimension 3: index into volume_groups; -1: none of its own
  std::string own_name;   ///< set by give_names; empty: the same as an earlier candidate
};

/// Sets the own names and returns the other ones. Throws core::InputError where one scope has two different
/// things of one name and dimension.
std::vector<GroupAlias> give_names(std::vector<Candidate>& candidates, Contents const& contents);

} // namespace fissura::mesh::inp
