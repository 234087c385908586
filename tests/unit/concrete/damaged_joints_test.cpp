// Batches of damaged joints stay from step to step while nothing happens to their joints.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "fissura/concrete/concrete.hpp"
#include "fissura/step/advance.hpp"
#include "support/concrete_model.hpp"

namespace fissura {
namespace {

using namespace support;

/// A box that flies apart while its nodes shake: its joints crack, break, close, part and are released.
struct Box {
  model::Model m;
  state::State s;
  state::Scratch w;

  Box() : m(concrete_model(random_box_mesh(5, {3, 3, 2}, {0.3, 0.3, 0.2}))) {
    m.source.contact.on = true;
    m.dt = 2e-7;
    s = concrete_state(m);
    w = concrete_scratch(m);
    Random random(3);
    for (int n = 0; n < node_count(m); ++n)
      set_node(s.v, n, 300 * (position(m, n) - Vec3{0.15, 0.15, 0.1}) + random.vector(-10, 10));
  }
  void step() {
    concrete::joint_forces(m, s, w);
    concrete::tet_forces_and_integrate(m, s, w, {}, {});
    ++s.step, s.time += m.dt;
  }
  void forget_batches() {
    for (auto& b : w.joints.batches) b.is_ready = false;
  }
  long ready() const {
    return std::count_if(w.joints.batches.begin(), w.joints.batches.end(),
                         [](auto const& b) { return b.is_ready; });
  }
  int count(state::JointStatus status) const {
    return static_cast<int>(
        std::count(s.joint_status.begin(), s.joint_status.end(), static_cast<std::uint8_t>(status)));
  }
};

template <class T> bool same_bits(core::Buffer<T> const& a, core::Buffer<T> const& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// Requirement: batches that stay give the same bits as batches collected anew in every step, through first
// damage, failure, sliding off and release.
TEST(DamagedJoints, batches_that_stay_change_nothing) {
  Box stays, anew;
  long most_ready = 0;
  for (int i = 0; i < 10'000; ++i) {
    stays.step();
    anew.forget_batches();
    anew.step();
    if (i % 100 == 0) most_ready = std::max(most_ready, stays.ready());
  }
  EXPECT_GT(most_ready, 10);
  EXPECT_GT(stays.count(state::JointStatus::broken), 0);
  EXPECT_GT(stays.count(state::JointStatus::released), 0);
  EXPECT_TRUE(same_bits(stays.s.u, anew.s.u));
  EXPECT_TRUE(same_bits(stays.s.v, anew.s.v));
  EXPECT_TRUE(same_bits(stays.s.joint_status, anew.s.joint_status));
}

// Requirement: tables made from a state, as at a restart, go on with the same bits as those that have
// followed it: sides of damaged joints apart, released joints gone.
TEST(DamagedJoints, tables_made_from_a_state_go_on_alike) {
  Box box;
  for (int i = 0; i < 6'000; ++i) box.step();
  ASSERT_GT(box.count(state::JointStatus::released), 0);
  ASSERT_GT(box.count(state::JointStatus::damaged) + box.count(state::JointStatus::broken), 0);
  Box again;
  std::copy(box.s.u.begin(), box.s.u.end(), again.s.u.begin());
  std::copy(box.s.v.begin(), box.s.v.end(), again.s.v.begin());
  std::copy(box.s.joint_status.begin(), box.s.joint_status.end(), again.s.joint_status.begin());
  std::copy(box.s.joint_history.begin(), box.s.joint_history.end(), again.s.joint_history.begin());
  again.s.step = box.s.step, again.s.time = box.s.time;
  again.w.joints = concrete::make_joint_slots(again.m, again.s);
  for (int i = 0; i < 1000; ++i) box.step(), again.step();
  EXPECT_TRUE(same_bits(box.s.u, again.s.u));
  EXPECT_TRUE(same_bits(box.s.v, again.s.v));
}

} // namespace
} // namespace fissura
