#pragma once
// Walks every number of what fields.hpp describes, each with its path, such as `bars.history[17].bond.K`.
#include <fmt/core.h>
#include <string>

#include "fissura/checkpoint/archive.hpp"

namespace fissura::checkpoint {

/// Takes the first name off a list that is parted by commas and blanks.
inline std::string_view take_name(std::string_view& names) {
  auto const end = std::min(names.find(','), names.size());
  auto const name = names.substr(0, end);
  names.remove_prefix(std::min(names.find_first_not_of(", ", end), names.size()));
  return name;
}

/// Calls visit(number, path) for every floating number of x, in the order of the description, until one call
/// returns true; tells whether one did. Slow: for what happens once.
template <class T, class Visit> bool walk_numbers(T& x, std::string const& path, Visit&& visit) {
  using Plain = std::remove_const_t<T>;
  if constexpr (std::is_floating_point_v<Plain>) {
    return visit(x, path);
  } else if constexpr (detail::is_number<Plain>) {
    return false;
  } else if constexpr (detail::is_array<Plain> || detail::is_list<Plain> || detail::is_buffer<Plain>) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (walk_numbers(x[i], fmt::format("{}[{}]", path, i), visit)) return true;
    return false;
  } else {
    auto names = field_names(x);
    auto const one = [&](auto& field) {
      std::string const inner = (path.empty() ? "" : path + ".") + std::string(take_name(names));
      return walk_numbers(field, inner, visit);
    };
    return std::apply([&](auto&... field) { return (one(field) || ...); }, detail::fields_of(x));
  }
}

} // namespace fissura::checkpoint
