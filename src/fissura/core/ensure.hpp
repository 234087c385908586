#pragma once
// What the program expects of itself, or of a library it calls, and cannot go on without.
#include <string>

#include "fissura/core/error.hpp"

namespace fissura::core {

/// Throws Error(Failure::run) "internal error: <what>" unless `sound`. Never for what a user may have caused:
/// that has an error of its own, with its place and its cure.
inline void ensure(bool sound, std::string const& what) {
  if (!sound) throw Error(Failure::run, "internal error: " + what);
}

} // namespace fissura::core
