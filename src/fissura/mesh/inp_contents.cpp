#include "fissura/mesh/inp_contents.hpp"

#include <utility>

#include <fmt/core.h>

#include "fissura/core/error.hpp"

namespace fissura::mesh::inp {

void Contents::refuse(int line, std::string message) const {
  throw core::InputError({file, line, 0}, std::move(message));
}

void Contents::bound(std::size_t count, std::size_t bytes_each, int line, char const* what) const {
  if (count >= always_allowed + size / bytes_each)
    refuse(line, fmt::format("more {} than a file of this size describes", what));
}

void Contents::copy(std::size_t count, int line) {
  if (count > copies_allowed || copied > copies_allowed - count)
    refuse(line,
           fmt::format("instances make more than {} nodes, elements and members of sets", copies_allowed));
  copied += count;
}

std::string shown(std::string const& text) {
  return text.size() <= 40 ? text : text.substr(0, 40) + "...";
}

} // namespace fissura::mesh::inp
