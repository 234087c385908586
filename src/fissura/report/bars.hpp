#pragma once
// Bars over the frames of a run: elements as lines, joints as places along each bar.
#include <cstdint>
#include <vector>

#include "fissura/output/read_frame.hpp"

namespace fissura::report {

struct BarFrame {
  std::vector<float> displacement;                     ///< 6 per element: both ends [m]
  std::vector<float> stress;                           ///< per element [Pa]
  std::vector<float> joint_stress, joint_strain, slip; ///< per joint [Pa], [-], [m]
};

struct Bars {
  // Elements, bar by bar, copy by copy, in the order along the bar.
  std::vector<float> points;            ///< 6 per element [m]
  std::vector<float> along;             ///< per element: where its middle lies along the bar [m]
  std::vector<std::uint16_t> bar, copy; ///< per element
  // Joints in the same order.
  std::vector<float> joint_along; ///< [m]
  std::vector<std::uint16_t> joint_bar, joint_copy;
  std::vector<std::uint8_t> joint_state; ///< in the last frame: 0 sound, 1 yielded, 2 broken
  std::vector<BarFrame> frames;

  /// Takes in the next frame; the first one gives the geometry.
  void take(output::FrameFile const& frame);

 private:
  void read_geometry(output::FrameFile const& frame);
  std::vector<std::size_t> joint_; ///< of each joint the first of its points in the file
};

} // namespace fissura::report
