#include <gtest/gtest.h>

#include "fissura/laws/softening.hpp"
#include "support/concrete_model.hpp"

namespace fissura::support {
namespace {

// Requirement: a joint that is given damage counts as damaged or broken, keeps z of its softening curve and
// stands in the slots as such; at rest it carries nothing.
TEST(SetDamage, makes_damaged_and_broken_joints) {
  auto const m = concrete_model(box_mesh({2, 1, 1}, {0.2, 0.1, 0.1}), plain_concrete());
  auto s = concrete_state(m);
  concrete::set_damage(m, s, 0, 0.3);
  concrete::set_damage(m, s, 1, 1);
  auto const n = concrete::count_joints(m, s);
  EXPECT_EQ(n.damaged, 2);
  EXPECT_EQ(n.broken, 1);
  EXPECT_EQ(s.joint_history.of(0).point[2].z, laws::softening(0.3));
  EXPECT_EQ(concrete::joint_energy(m, s), 0);
  state::Scratch w;
  w.joints = concrete::make_joint_slots(m, s);
  auto const& face = m.adjacency.shared[m.joints.joints[0].shared_face];
  auto const place = w.joints.place[model::at(static_cast<std::size_t>(face.b.tet), 3 * face.b.face, 12)];
  EXPECT_GE(place, static_cast<int>(w.joints.side_b(0))) << "side b of a damaged joint has its own slot";
  EXPECT_LT(place, static_cast<int>(w.joints.side_b(1)));
  concrete::joint_forces(m, s, w);
  for (double const f : w.joints.force) EXPECT_EQ(f, 0);
}

} // namespace
} // namespace fissura::support
