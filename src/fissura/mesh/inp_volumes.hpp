#pragma once
// Which element set of a part is the volume group of each of its tets.
#include <vector>

#include "fissura/mesh/inp_contents.hpp"

namespace fissura::mesh::inp {

/// The volume groups of a part: sets that share no tet.
struct Volumes {
  std::vector<int> sets; ///< places in element_sets.list, in the order in which the file first calls for them
  std::vector<int> of_element; ///< per element: index into sets; -1: in none of them
};

/// With *SOLID SECTIONs the sets that they name. Without, the *ELSETs, small ones first: one that others make
/// up is no group of its own, only a name of theirs; then the ELSETs of *ELEMENT lines whose tets are still
/// free. Throws core::InputError where a tet would have two.
Volumes volumes_of(Contents const& contents, Scope const& part);

} // namespace fissura::mesh::inp
