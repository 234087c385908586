#include "fissura/mesh/inp_element_types.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace fissura::mesh::inp {

namespace {

/// Whether `type` is the shape followed by letters only: C3D4H is a C3D4, C3D4R too, C3D40 is not.
bool is_shape(std::string_view type, std::string_view shape) {
  auto const is_letter = [](char c) { return c >= 'A' && c <= 'Z'; };
  return type.starts_with(shape) &&
         std::all_of(type.begin() + static_cast<std::ptrdiff_t>(shape.size()), type.end(), is_letter);
}

template <std::size_t count>
bool is_one_of(std::string_view type, std::array<std::string_view, count> const& shapes) {
  return std::any_of(shapes.begin(), shapes.end(), [&](auto shape) { return is_shape(type, shape); });
}
template <std::size_t count>
bool begins_with_one_of(std::string_view type, std::array<std::string_view, count> const& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(), [&](auto b) { return type.starts_with(b); });
}

constexpr std::array<std::string_view, 6> lines{"T3D2", "B31", "B33", "B31OS", "PIPE31", "FRAME3D"};
constexpr std::array<std::string_view, 8> triangles{"S3",    "STRI3", "CPS3",   "CPE3",
                                                    "CPEG3", "M3D3",  "SFM3D3", "DS3"};
/// Solids of other shapes, layers between solids, and bars with nodes in the middle.
constexpr std::array<std::string_view, 13> bodies{"C3D", "DC3D", "DCC3D", "AC3D", "EC3D",  "PC3D", "PD3D",
                                                  "Q3D", "F3D",  "SC6",   "SC8",  "COH3D", "CSS8"};
constexpr std::array<std::string_view, 3> curved_bars{"T3D3", "B32", "PIPE32"};

} // namespace

TypeFate fate_of(std::string const& type) {
  if (is_shape(type, "C3D4")) return {Fate::read, Kind::tet};
  if (is_one_of(type, lines)) return {Fate::read, Kind::line};
  if (is_one_of(type, triangles)) return {Fate::read, Kind::triangle};
  if (begins_with_one_of(type, bodies) || begins_with_one_of(type, curved_bars))
    return {Fate::refused, Kind::other};
  return {Fate::left_out, Kind::other};
}

} // namespace fissura::mesh::inp
