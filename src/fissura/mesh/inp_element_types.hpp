#pragma once
// What becomes of an element by the name of its type.
#include <string>

#include "fissura/mesh/inp_contents.hpp"

namespace fissura::mesh::inp {

enum class Fate {
  read,     ///< a tet, a triangle or a line
  left_out, ///< no body: masses, springs, rigid and structural shells, connectors
  refused   ///< a body, or a bar, in a shape that is not known: without it the model would be another one
};
struct TypeFate {
  Fate fate = Fate::left_out;
  Kind kind = Kind::other;
};

/// `type` in capitals. Suffixes for hybrid, thermal and coupled formulations do not change the shape.
TypeFate fate_of(std::string const& type);

} // namespace fissura::mesh::inp
