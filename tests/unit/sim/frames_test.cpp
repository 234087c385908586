// What frames show of a state. What other programs make of the files: tests/look/reading_test.py.
#include <gtest/gtest.h>

#include "fissura/concrete/concrete.hpp"
#include "fissura/sim/fields.hpp"
#include "support/cases.hpp"

namespace fissura::support {
namespace {

template <class T> std::vector<T> values(std::vector<output::Array> const& arrays, std::string const& name) {
  for (auto const& a : arrays)
    if (a.name == name) return std::get<std::vector<T>>(a.values);
  ADD_FAILURE() << "no array " << name;
  return {};
}

// Requirement: a bar is one polyline with two points per element; where it has ruptured it is two, and no
// point changes its place in the file.
TEST(Frames, break_a_bar_where_it_has_ruptured) {
  Stepper x(tie_case({4, 2, 2}, 1, 2));
  auto const whole = sim::bar_lines(x.m, x.s);
  std::size_t const elements = x.m.bars.elements.size();
  ASSERT_EQ(whole.types.size(), 1u);
  ASSERT_EQ(whole.points.size(), 2 * elements);
  ASSERT_GT(x.m.bars.joints.size(), 1u);
  x.s.bars.history[1].ruptured = true;
  auto const broken = sim::bar_lines(x.m, x.s);
  ASSERT_EQ(broken.types.size(), 2u);
  auto const joint = values<std::int32_t>(broken.point_data, "joint");
  auto const end = static_cast<std::size_t>(broken.offsets[0]);
  EXPECT_EQ(joint[end - 1], 1);
  EXPECT_EQ(joint[end], 1);
  EXPECT_EQ(values<std::int32_t>(broken.point_data, "broken")[end], 1);
  ASSERT_EQ(whole.points.size(), broken.points.size());
  for (std::size_t i = 0; i < whole.points.size(); ++i)
    EXPECT_LT(norm(whole.points[i] - broken.points[i]), 1e-15) << i;
  EXPECT_EQ(broken.names[0].names.size(), x.m.source.bars.size());
}

// Requirement: a frame without damage holds the first joint of the model as it is, undamaged; a model without
// joints has none.
TEST(Frames, show_a_sound_joint_where_there_is_no_crack) {
  Stepper const x(tie_case({2, 1, 1}, 1, 2));
  EXPECT_EQ(sim::crack_grid(x.m, x.s).types.size(), 0u);
  auto const frame = sim::crack_frame(x.m, x.s);
  ASSERT_EQ(frame.types.size(), 1u);
  EXPECT_EQ(values<float>(frame.cell_data, "damage")[0], 0);
  EXPECT_EQ(values<float>(frame.cell_data, "opening")[0], 0);
  EXPECT_EQ(values<std::int32_t>(frame.cell_data, "broken")[0], 0);
  auto bonded = tie_case({2, 1, 1}, 1, 2);
  for (auto& c : bonded.concretes) c.joints = false;
  Stepper const y(bonded);
  EXPECT_EQ(sim::crack_frame(y.m, y.s).types.size(), 0u);
}

// Requirement: the surface of a sound body is its outer faces alone; each cracked joint adds its two faces.
TEST(Frames, add_both_faces_of_each_crack_to_the_surface) {
  Stepper x(tie_case({4, 2, 2}, 1, 2));
  auto const sound = sim::surface_grid(x.m, x.s);
  EXPECT_EQ(sound.types.size(), x.m.adjacency.boundary.size());
  x.advance(600);
  int const cracked = concrete::count_joints(x.m, x.s).cracked;
  ASSERT_GT(cracked, 0);
  auto const cracks = sim::surface_grid(x.m, x.s);
  EXPECT_EQ(cracks.types.size(), x.m.adjacency.boundary.size() + 2 * static_cast<std::size_t>(cracked));
  EXPECT_LE(cracks.points.size(), cracks.connectivity.size());
}

} // namespace
} // namespace fissura::support
