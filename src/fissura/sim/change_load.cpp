#include "fissura/sim/change_load.hpp"

#include <algorithm>
#include <fmt/core.h>

#include "fissura/core/error.hpp"
#include "fissura/loads/loads.hpp"

namespace fissura::sim {

using model::Curve;
using model::Model;
using state::State;

namespace {

[[noreturn]] void refuse(std::string message) {
  throw core::Error(core::Failure::input, std::move(message));
}

void check_stage(Model const& m, State const& s, std::string const& name, int stage) {
  if (stage > s.stage)
    refuse(fmt::format("`{}` begins with the stage `{}`, which has not begun yet", name,
                       m.stages[static_cast<std::size_t>(stage)].name));
}

void begin_now(model::TimedCurve& timed, State const& s, Curve curve, double present) {
  if (curve.kind == Curve::Kind::ramp) curve.from = present;
  timed = {std::move(curve), -1, s.load_time()};
}

void change_motion(Model& m, State const& s, std::size_t i, std::string const& key, Curve curve) {
  auto& p = m.prescribed[i];
  if (p.path >= 0) refuse(fmt::format("`{}` follows a path that gauges steer: it cannot be changed", p.name));
  if (key != "displacement" && key != "velocity")
    refuse(fmt::format("`{}` is a motion: give `displacement` or `velocity`, not `{}`", p.name, key));
  check_stage(m, s, p.name, p.motion.stage);
  p.is_velocity = key == "velocity";
  auto const first = static_cast<std::size_t>(p.nodes.empty() ? 0 : p.nodes.front());
  double const present = p.is_velocity ? s.prescribed_velocity[i] / s.pace : s.u(first, p.axis);
  begin_now(p.motion, s, std::move(curve), present);
}

void change_force(Model& m, State const& s, model::AppliedForce& f, std::string const& key, Curve curve) {
  auto const& tractions = m.source.tractions;
  bool const traction =
      std::any_of(tractions.begin(), tractions.end(), [&](auto const& t) { return t.name == f.name; });
  char const* const own = traction ? "traction" : "force";
  if (key != own) refuse(fmt::format("`{}` is a {}: give `{}`, not `{}`", f.name, own, own, key));
  check_stage(m, s, f.name, f.curve.stage);
  begin_now(f.curve, s, std::move(curve), loads::value_at(f.curve, s, s.load_time()));
}

std::string names_of_loads(Model const& m) {
  std::string names;
  auto const add = [&](std::string const& name) {
    names += fmt::format("{}`{}`", names.empty() ? "" : ", ", name);
  };
  for (auto const& spec : m.source.motions) add(spec.name);
  for (auto const& f : m.forces) add(f.name);
  if (m.gravity.on) add("gravity");
  return names.empty() ? "none" : names;
}

} // namespace

void change_load(Model& m, State const& s, std::string const& name, std::string const& key, Curve curve) {
  for (auto const& spec : m.source.motions)
    if (spec.name == name)
      for (std::size_t i = 0; i < m.prescribed.size(); ++i)
        if (m.prescribed[i].name == name) return change_motion(m, s, i, key, std::move(curve));
  for (auto& f : m.forces)
    if (f.name == name) return change_force(m, s, f, key, std::move(curve));
  if (name == "gravity" && m.gravity.on) {
    if (key != "acceleration") refuse(fmt::format("gravity has an `acceleration`, no `{}`", key));
    check_stage(m, s, name, m.gravity.curve.stage);
    return begin_now(m.gravity.curve, s, std::move(curve),
                     loads::value_at(m.gravity.curve, s, s.load_time()));
  }
  refuse(fmt::format("there is no load `{}` to change; there are: {}", name, names_of_loads(m)));
}

} // namespace fissura::sim
