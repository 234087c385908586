#include "fissura/model/defaults.hpp"

#include <algorithm>

namespace fissura::model {

bool is_fast(Case const& c) {
  return !c.impactors.empty() || !c.planes.empty() || !c.initial_velocities.empty() || !c.absorbing.empty() ||
         std::any_of(c.concretes.begin(), c.concretes.end(),
                     [](ConcreteSpec const& k) { return k.rate_factor != RateFactor::none; });
}

bool has_local_damping(Case const& c) {
  return c.run.local_damping > 0 || std::any_of(c.stages.begin(), c.stages.end(),
                                                [](StageSpec const& s) { return s.local_damping > 0; });
}

bool may_have_joint_inertia(Case const& c) {
  if (c.run.joint_inertia != JointInertia::automatic) return c.run.joint_inertia == JointInertia::on;
  bool const has_joints =
      std::any_of(c.concretes.begin(), c.concretes.end(), [](ConcreteSpec const& k) { return k.joints; });
  return has_joints && !is_fast(c) && !has_local_damping(c) && c.run.least_dt == 0 && c.run.dt == 0;
}

double joint_penalty(ConcreteSpec const& concrete) {
  return concrete.penalty > 0 ? concrete.penalty : default_penalty * concrete.E;
}

} // namespace fissura::model
