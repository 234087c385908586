// Damaged joints and their lanes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

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

  explicit Box(model::ConcreteSpec const& concrete = plain_concrete(), std::array<int, 3> cells = {3, 3, 2})
      : m(concrete_model(random_box_mesh(5, cells, {0.3, 0.3, 0.2}), concrete)) {
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
    move();
  }
  void move() {
    concrete::tet_forces_and_integrate(m, s, w, {}, {});
    ++s.step, s.time += m.dt;
  }
  int count(state::JointStatus status) const {
    return static_cast<int>(
        std::count(s.joint_status.begin(), s.joint_status.end(), static_cast<std::uint8_t>(status)));
  }
};

template <class T> bool same_bits(core::Buffer<T> const& a, core::Buffer<T> const& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// Never used, or used and cleared.
bool is_bare(state::JointHistory history) {
  for (auto& point : history.point) point.z = 0; // 1 where there was a joint once
  std::array<double, state::JointHistory::doubles> const nothing{};
  return std::memcmp(&history, nothing.data(), sizeof history) == 0;
}

/// The history of every joint that has one, by its lane: nothing else may be there.
void expect_lanes_in_order(state::State const& s, state::JointSlots const& slots) {
  auto const& h = s.joint_history;
  for (std::size_t g = 0; g < h.groups(); ++g) {
    auto const n = state::count_lanes(s, g);
    ASSERT_EQ(n.at_work, slots.lanes[g].at_work);
    ASSERT_EQ(n.released, slots.lanes[g].released);
    std::vector<int> joint_in(h.room(g), -1);
    for (std::size_t j = h.first_of(g); j < h.first_of(g) + h.room(g); ++j)
      if (s.joint_status[j] != 0) {
        ASSERT_EQ(joint_in[h.lane[j]], -1) << "two joints in one lane";
        joint_in[h.lane[j]] = static_cast<int>(j);
      }
    for (int lane = 0; lane < static_cast<int>(h.room(g)); ++lane) {
      std::size_t const place = h.place(g, lane), row = place / model::block, at = place % model::block;
      bool const is_at_work = lane < n.at_work;
      EXPECT_EQ(joint_in[static_cast<std::size_t>(lane)] >= 0,
                is_at_work || lane >= static_cast<int>(h.room(g)) - n.released);
      if (is_at_work) {
        EXPECT_EQ(slots.batches[row].joint[at], joint_in[static_cast<std::size_t>(lane)]);
      } else if (joint_in[static_cast<std::size_t>(lane)] < 0) {
        EXPECT_TRUE(is_bare(h.rows[row].of(at))) << "something was left behind";
      }
    }
  }
}

// Requirement: damaged joints have the first lanes of their group, released ones the last, each its own, and
// the lanes between are empty, through first damage, failure, sliding off and release.
TEST(DamagedJoints, have_lanes_without_gaps) {
  Box box;
  int most_damaged = 0;
  for (int i = 0; i < 10'000; ++i) {
    box.step();
    if (i % 50 == 0) expect_lanes_in_order(box.s, box.w.joints);
    most_damaged = std::max(most_damaged, box.count(state::JointStatus::damaged));
  }
  EXPECT_GT(most_damaged, 10);
  EXPECT_GT(box.count(state::JointStatus::broken), 0);
  EXPECT_GT(box.count(state::JointStatus::released), 10);
}

struct EnergyCase {
  char const* name;
  void (*change)(model::ConcreteSpec&);
  bool two_laws;
};
class EnergyInBatches : public testing::TestWithParam<EnergyCase> {};

// Requirement: the energy that batches hold is that of their joints one by one, to 1e-12 of the most there
// was, through first damage, failure, sliding off and release, in several groups, and just after lanes have
// changed hands.
TEST_P(EnergyInBatches, is_that_of_the_joints_alone) {
  auto concrete = plain_concrete();
  GetParam().change(concrete);
  Box box(concrete, {4, 4, 3});
  ASSERT_GT(box.s.joint_history.groups(), 1U);
  if (GetParam().two_laws) {
    box.m.joints.kinds.push_back(box.m.joints.kinds[0]);
    box.m.joints.kinds[1].o_r *= 3;
    for (std::size_t j = 0; j < box.m.joints.kind.size(); j += 3) box.m.joints.kind[j] = 1;
    box.w = concrete_scratch(box.m);
  }
  double most = 0;
  for (int i = 0; i < 8'000; ++i) {
    concrete::joint_forces(box.m, box.s, box.w);
    if (i % 17 == 0) {
      double const alone = concrete::joint_energy(box.m, box.s);
      most = std::max(most, alone);
      ASSERT_NEAR(concrete::joint_energy(box.m, box.s, box.w.joints), alone, 1e-12 * most) << "step " << i;
    }
    box.move();
  }
  EXPECT_GT(most, 0);
  EXPECT_GT(box.count(state::JointStatus::damaged) + box.count(state::JointStatus::broken), 0);
  EXPECT_GT(box.count(state::JointStatus::released), 10);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, EnergyInBatches,
    testing::Values(
        EnergyCase{"mohr_coulomb", [](model::ConcreteSpec&) {}, false},
        EnergyCase{"paper", [](model::ConcreteSpec& c) { c.joint_law = model::JointLaw::paper; }, false},
        EnergyCase{"constant_shear",
                   [](model::ConcreteSpec& c) { c.shear = model::ShearStrength::constant, c.f_s = 5e6; },
                   false},
        EnergyCase{"rate", [](model::ConcreteSpec& c) { c.rate_factor = model::RateFactor::mc2010; }, false},
        EnergyCase{"two_laws", [](model::ConcreteSpec&) {}, true}),
    [](auto const& i) { return std::string(i.param.name); });

// Requirement: tables made from a state, as at a restart, go on with the same bits as those that have
// followed it: sides of damaged joints apart, released joints gone.
TEST(DamagedJoints, tables_made_from_a_state_go_on_alike) {
  Box box;
  for (int i = 0; i < 6'000; ++i) box.step();
  ASSERT_GT(box.count(state::JointStatus::released), 0);
  ASSERT_GT(box.count(state::JointStatus::damaged) + box.count(state::JointStatus::broken), 0);
  Box again;
  std::copy(box.s.u.values.begin(), box.s.u.values.end(), again.s.u.values.begin());
  std::copy(box.s.v.values.begin(), box.s.v.values.end(), again.s.v.values.begin());
  std::copy(box.s.joint_status.begin(), box.s.joint_status.end(), again.s.joint_status.begin());
  std::copy(box.s.joint_history.lane.begin(), box.s.joint_history.lane.end(),
            again.s.joint_history.lane.begin());
  std::copy(box.s.joint_history.rows.begin(), box.s.joint_history.rows.end(),
            again.s.joint_history.rows.begin());
  again.s.step = box.s.step, again.s.time = box.s.time;
  again.w.joints = concrete::make_joint_slots(again.m, again.s);
  for (int i = 0; i < 1000; ++i) box.step(), again.step();
  EXPECT_TRUE(same_bits(box.s.u.values, again.s.u.values));
  EXPECT_TRUE(same_bits(box.s.v.values, again.s.v.values));
}

} // namespace
} // namespace fissura
