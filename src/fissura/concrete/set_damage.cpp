#include "fissura/concrete/concrete.hpp"
#include "fissura/laws/softening.hpp"

namespace fissura::concrete {

void set_damage(model::Model const& m, state::State& s, int joint, double kappa) {
  auto const j = static_cast<std::size_t>(joint);
  auto const law = m.joints.law(joint);
  for (auto& point : s.joint_history[j].point) {
    point.kappa = kappa;
    point.z = laws::softening(kappa);
    if (law.mohr_coulomb) point.f_s = law.f_s;
  }
  auto const status = kappa >= 1 ? state::JointStatus::broken : state::JointStatus::damaged;
  s.joint_status[j] = static_cast<std::uint8_t>(status);
}

} // namespace fissura::concrete
