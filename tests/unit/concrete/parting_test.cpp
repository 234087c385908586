// The end of joints whose faces turn away from each other.
#include <gtest/gtest.h>

#include "fissura/concrete/parting.hpp"
#include "support/concrete_model.hpp"

namespace fissura {
namespace {

using namespace support;

double stored(model::Model const& m, state::State const& s, int joint, bool broken) {
  auto const h = s.joint_history.of(static_cast<std::size_t>(joint));
  auto const law = laws::with_strength(m.joints.law(joint), state::strength_factor(s, joint));
  double sum = 0;
  for (int q = 0; q < 3; ++q)
    sum += m.joints.joints[joint].area / 3 * laws::cohesive_stored(law, h.point[q], h.last[q], broken);
  return sum;
}

// Requirement: when a turned joint breaks at its hinge, what it no longer holds is booked by kind, no account
// falls, and points under pressure keep the energy of the pressure; also where the strain rate has raised the
// strengths.
TEST(Parting, a_hinge_that_breaks_books_what_it_held) {
  auto concrete = plain_concrete();
  concrete.rate_factor = model::RateFactor::mc2010;
  auto const m = concrete_model(box_mesh({1, 1, 1}, {0.1, 0.1, 0.1}), concrete);
  auto s = concrete_state(m);
  s.joint_rate = core::Buffer<state::JointRate>(m.joints.blocks() * model::block);
  int const joint = 0;
  s.joint_rate[joint].excess = 0.5;
  auto const law = m.joints.law(joint);
  concrete::set_damage(m, s, joint, 0.4);
  state::JointHistory h;
  double const o = law.o_p, damaged_o = 0.5 * (law.o_p + 0.4 * law.o_r);
  h.point[0] = {0.4, 0.5, law.f_s, 0, 0}, h.last[0] = {damaged_o, 3 * o, -o};       // open, slid
  h.point[1] = {0, 1, 0, 0, 0}, h.last[1] = {-2 * o, 0.1 * o, 0};                   // pressed, never damaged
  h.point[2] = {0.2, 0.7, law.f_s, 0.2 * o, 0}, h.last[2] = {-o, 0.5 * o, 0.3 * o}; // pressed, rubbing
  s.joint_history.set(joint, h);
  double const before = stored(m, s, joint, false);
  auto now = concrete::joint_kinematics(m, s, joint);
  double const size = norm(now.mid[1] - now.mid[0]); // side b turned away far beyond 60 degrees
  now.jump = {Vec3{}, 3 * size * now.normal, 3 * size * now.normal};

  concrete::break_at_hinge(m, s, joint, now);
  h = s.joint_history.of(joint);

  for (auto const& point : h.point) EXPECT_EQ(point.kappa, 1);
  double const after = stored(m, s, joint, true), area = m.joints.joints[joint].area;
  EXPECT_NEAR(after, area / 3 * 0.5 * law.k * (4 * o * o + o * o), 1e-12 * before);
  EXPECT_GT(h.dissipated.mode_I, 0);
  EXPECT_GT(h.dissipated.mode_II, 0);
  EXPECT_GT(h.dissipated.friction, 0);
  EXPECT_NEAR(h.dissipated.mode_I + h.dissipated.mode_II + h.dissipated.friction, before - after,
              1e-12 * before);
}

} // namespace
} // namespace fissura
