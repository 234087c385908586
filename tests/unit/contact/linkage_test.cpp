#include <gtest/gtest.h>

#include "fissura/contact/linkage.hpp"
#include "support/concrete_model.hpp"

namespace fissura::contact {
namespace {

using state::JointStatus;

struct Block {
  model::Model m = support::concrete_model(support::box_mesh({2, 1, 1}, {0.2, 0.1, 0.1}));
  state::State s = support::concrete_state(m);

  double x_of(int tet) const {
    auto const x = mesh::corners(m.mesh, tet);
    return 0.25 * (x[0].x + x[1].x + x[2].x + x[3].x);
  }
  /// Gives a status to the joints across the plane x = 0.1, up to a height.
  int set_middle(JointStatus status, double up_to) {
    int count = 0;
    for (int j = 0; j < m.joint_count(); ++j) {
      auto const& face = m.adjacency.shared[m.joints.joints[j].shared_face];
      if ((x_of(face.a.tet) < 0.1) == (x_of(face.b.tet) < 0.1)) continue;
      auto const x = mesh::corners(m.mesh, face.a.tet);
      double z = 0;
      for (int const c : face.corner_a) z += x[c].z / 3;
      if (z < up_to) s.joint_status[j] = static_cast<std::uint8_t>(status), ++count;
    }
    return count;
  }
};

// Requirement: broken joints that still carry pressure hold their tets together; parted ones make two bodies.
TEST(Linkage, counts_bodies) {
  Block b;
  EXPECT_EQ(find_linkage(b.m, b.s).bodies, 1);
  EXPECT_EQ(b.set_middle(JointStatus::broken, 1), 2);
  EXPECT_EQ(find_linkage(b.m, b.s).bodies, 1);
  b.set_middle(JointStatus::released, 1);
  auto const link = find_linkage(b.m, b.s);
  EXPECT_EQ(link.bodies, 2);
  for (int t = 0; t < b.m.tet_count(); ++t)
    EXPECT_EQ(link.body[t] == link.body[0], (b.x_of(t) < 0.1) == (b.x_of(0) < 0.1));
}

// Requirement: tets on both sides of a crack that goes right through do not count as linked, tets beside a
// crack that ends at their common point do.
TEST(Linkage, ends_where_the_crack_goes_through) {
  Block b;
  b.set_middle(JointStatus::released, 1);
  auto link = find_linkage(b.m, b.s);
  int across = 0, beside = 0;
  for (int i = 0; i < b.m.tet_count(); ++i)
    for (int k = i + 1; k < b.m.tet_count(); ++k) {
      bool const same_side = (b.x_of(i) < 0.1) == (b.x_of(k) < 0.1);
      EXPECT_FALSE(!same_side && are_linked(b.m, b.s, link, i, k));
      across += !same_side;
      beside += same_side && are_linked(b.m, b.s, link, i, k);
    }
  EXPECT_GT(across, 0);
  EXPECT_GT(beside, 0);

  Block half; // one of the two faces of the plane holds
  EXPECT_EQ(half.set_middle(JointStatus::released, 0.04), 1);
  link = find_linkage(half.m, half.s);
  EXPECT_EQ(link.bodies, 1);
  for (int j = 0; j < half.m.joint_count(); ++j) {
    auto const& face = half.m.adjacency.shared[half.m.joints.joints[j].shared_face];
    if (half.s.joint_status[j] > 0) {
      EXPECT_FALSE(are_linked(half.m, half.s, link, face.a.tet, face.b.tet)) << "they were face to face";
    } else {
      EXPECT_TRUE(are_linked(half.m, half.s, link, face.a.tet, face.b.tet));
    }
  }
}

// Requirement: the surface is what has a free face; parting a joint adds its two tets.
TEST(Linkage, knows_the_surface) {
  Block inner;
  EXPECT_FALSE(surface_tets(inner.m, inner.s).empty());
  for (int j = 0; j < inner.m.joint_count(); ++j)
    inner.s.joint_status[j] = static_cast<std::uint8_t>(JointStatus::parting);
  EXPECT_EQ(surface_tets(inner.m, inner.s).size(), static_cast<std::size_t>(inner.m.tet_count()));
}

} // namespace
} // namespace fissura::contact
