#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/joint_lanes.hpp"
#include "fissura/laws/softening.hpp"

namespace fissura::concrete {

using state::JointStatus;

void set_damage(model::Model const& m, state::State& s, int joint, double kappa) {
  auto const j = static_cast<std::size_t>(joint);
  if (state::status_of(s, joint) == JointStatus::intact) {
    int const lane = state::count_lanes(s, j / state::JointHistories::group).at_work;
    s.joint_history.lane[j] = static_cast<std::uint8_t>(lane);
  }
  auto const law = m.joints.law(joint);
  auto history = s.joint_history.of(j);
  for (auto& point : history.point) {
    point.kappa = kappa;
    point.z = laws::softening(kappa);
    if (law.mohr_coulomb) point.f_s = law.f_s;
  }
  s.joint_history.set(j, history);
  state::set_status(s, joint, kappa >= 1 ? JointStatus::broken : JointStatus::damaged);
}

} // namespace fissura::concrete
