#include "fissura/sim/joint_fields.hpp"

#include <algorithm>
#include <cmath>

#include "fissura/concrete/concrete.hpp"

namespace fissura::sim {

void JointFields::add(model::Model const& m, state::State const& s, int joint) {
  auto const status = static_cast<state::JointStatus>(s.joint_status[joint]);
  auto const kinematics = concrete::joint_kinematics(m, s, joint);
  double o = 0, slid = 0;
  for (auto const& at : kinematics.at) {
    o += at.opening / 3;
    slid += std::hypot(at.sliding_1, at.sliding_2) / 3;
  }
  opening_.push_back(static_cast<float>(o));
  sliding_.push_back(static_cast<float>(slid));
  broken_.push_back(status >= state::JointStatus::broken);
  if (status == state::JointStatus::intact) { // it has no history yet
    damage_.push_back(0), failed_.push_back(0), lost_I_.push_back(0), lost_II_.push_back(0);
    mode_.push_back(0);
    return;
  }
  auto const history = s.joint_history.of(static_cast<std::size_t>(joint));
  double kappa = 0;
  for (auto const& point : history.point) kappa += point.kappa / 3;
  damage_.push_back(static_cast<float>(kappa));
  failed_.push_back(static_cast<float>(history.time_of_failure));
  lost_I_.push_back(static_cast<float>(history.dissipated.mode_I));
  lost_II_.push_back(static_cast<float>(history.dissipated.mode_II));
  mode_.push_back(static_cast<std::int32_t>(laws::crack_mode(history.dissipated)));
}

void JointFields::add_none() {
  for (auto* field : {&opening_, &sliding_, &damage_, &failed_, &lost_I_, &lost_II_}) field->push_back(0);
  mode_.push_back(0), broken_.push_back(0);
}

std::vector<output::Array> JointFields::arrays() const {
  return {{"opening", 1, opening_, "m"},   {"sliding", 1, sliding_, "m"},        {"damage", 1, damage_, "-"},
          {"mode", 1, mode_, "-"},         {"time_of_failure", 1, failed_, "s"}, {"broken", 1, broken_, "-"},
          {"fracture_I", 1, lost_I_, "J"}, {"fracture_II", 1, lost_II_, "J"}};
}

bool is_cracked(state::State const& s, int joint) {
  if (static_cast<state::JointStatus>(s.joint_status[joint]) == state::JointStatus::intact) return false;
  auto const history = s.joint_history.of(static_cast<std::size_t>(joint));
  return std::all_of(history.point.begin(), history.point.end(), [](auto const& p) { return p.kappa > 0; });
}

} // namespace fissura::sim
