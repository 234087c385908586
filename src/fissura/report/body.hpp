#pragma once
// What of the body is seen: the faces that one tet alone has, and those along which fragments have parted.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fissura/output/read_frame.hpp"

namespace fissura::report {

struct Body {
  std::vector<std::uint32_t> node;      ///< point of the frames' grid of each point shown
  std::vector<float> points;            ///< x, y, z of each [m]
  std::vector<std::uint32_t> triangles; ///< three points each, counter-clockwise from outside
  std::vector<std::uint32_t> tet;       ///< cell of each triangle
  std::vector<std::int32_t> across;     ///< cell behind each triangle, or -1: outside
  std::vector<std::uint8_t> group;      ///< volume group of each triangle
  std::array<double, 3> low{}, high{};  ///< corners of the bounding box [m]
  std::size_t tets = 0;                 ///< in the frames
  double edge = 0;                      ///< mean length of the tets' edges [m]
};

/// From the first frame of the tets: all outer faces; and from the last, where there is more than one
/// fragment, both sides of every face between two of them.
Body find_body(output::FrameFile const& first, output::FrameFile const& last);

/// For each triangle the first of the given frames in which it is seen: 0 for outer faces, else that in which
/// its two tets belong to different fragments; the number of frames if never.
class Appearance {
 public:
  Appearance(Body const& body, std::size_t frames);
  void take(Body const& body, output::FrameFile const& frame, std::size_t number);
  std::vector<std::uint16_t> const& first() const { return first_; }

 private:
  std::vector<std::uint16_t> first_;
};

} // namespace fissura::report
