#include "fissura/sim/summary.hpp"

#include <algorithm>
#include <fmt/core.h>

#include "fissura/concrete/concrete.hpp"
#include "fissura/concrete/kernels.hpp"
#include "fissura/output/json.hpp"
#include "fissura/sim/fragments.hpp"
#include "fissura/sim/gauges.hpp"
#include "fissura/sim/state_hash.hpp"

namespace fissura::sim {

using model::Model;
using state::State;

namespace {

output::Json failure(Outcome const& o) {
  Trouble const& t = *o.trouble;
  output::Json j = output::Json::object();
  j["kind"] = t.kind;
  j["what"] = t.what;
  j["where"] = describe(t.spot);
  j["tet"] = t.spot.tet;
  j["group"] = t.spot.group;
  if (t.spot.has_place) j["at"] = output::Json::array({t.spot.at.x, t.spot.at.y, t.spot.at.z});
  j["time"] = t.time;
  j["step"] = t.step;
  j["cause"] = t.cause;
  j["cure"] = t.cure;
  if (!o.checkpoint.empty()) j["checkpoint"] = o.checkpoint;
  if (!o.frame.empty()) j["frame"] = o.frame; // the fields as they were
  return j;
}

/// Planes and impactors as they are at the end.
output::Json rigid_bodies(Model const& m, State const& s) {
  auto const vector = [](Vec3 v) { return output::Json::array({v.x, v.y, v.z}); };
  output::Json list = output::Json::array();
  for (std::size_t i = 0; i < m.rigid.size(); ++i) {
    auto const& b = s.rigid.body[i];
    output::Json j = output::Json::object();
    j["name"] = m.rigid[i].name;
    j["contact_impulse"] = vector(b.impulse);
    if (m.rigid[i].is_impactor) {
      j["mass"] = m.rigid[i].mass;
      j["displacement"] = vector(b.u);
      j["velocity"] = vector(b.v);
    }
    list.push_back(j);
  }
  return list;
}

} // namespace

output::Json summary(Model const& m, State const& s, Outcome const& o) {
  auto const joints = concrete::count_joints(m, s);
  auto const bars = count_bars(s.bars);
  auto const inertia = o.monitor.inertia();
  output::Json energy = output::Json::object();
  for (auto const& [name, value] : o.energy.accounts()) energy[std::string(name)] = value;
  output::Json j = output::Json::object();
  j["status"] = o.result.status;
  j["reason"] = o.result.reason;
  j["version"] = o.version;
  j["title"] = m.source.title;
  j["threads"] = o.threads;
  j["kernels"] = std::string(concrete::kernels().name);
  j["tets"] = m.tet_count();
  j["joints"] = m.joint_count();
  j["bar_elements"] = m.bars.elements.size();
  j["bar_joints"] = m.bars.joints.size();
  j["dt"] = m.dt;
  j["steps"] = s.step;
  j["time"] = s.time;
  if (o.has_pace) j["mean_pace"] = s.load_time() / std::max(s.time, 1e-300);
  j["wall_seconds"] = o.wall_seconds;
  j["tet_steps_per_second"] = static_cast<double>(s.step) * m.tet_count() / std::max(o.wall_seconds, 1e-9);
  j["joints_damaged"] = joints.damaged;
  j["joints_cracked"] = joints.cracked;
  j["joints_broken"] = joints.broken;
  j["bar_joints_activated"] = bars.activated;
  j["bar_joints_yielded"] = bars.yielded;
  j["bars_broken"] = bars.broken;
  j["fragments"] = fragments_json(find_fragments(m, s));
  j["energy"] = energy;
  j["energy_residual"] = o.monitor.residual();
  j["max_kinetic_ratio"] = o.monitor.kinetic_ratio();
  j["quasi_static"] = inertia.is_quasi_static();
  j["quasi_static_share"] = inertia.quiet_share;
  j["force_imbalance"] = inertia.imbalance;
  j["vibration_period"] = inertia.period;
  j["state_hash"] = fmt::format("{:016x}", state_hash(m, s));
  j["stable_dt_limiter"] = m.dt_limiter;
  j["added_mass"] = m.added_mass;
  j["total_mass"] = m.total_mass;
  if (!m.rigid.empty()) j["rigid_bodies"] = rigid_bodies(m, s);
  if (o.trouble) j["failure"] = failure(o);
  return j;
}

} // namespace fissura::sim
