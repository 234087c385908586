// [run] and [output].
#include <fmt/core.h>

#include "fissura/deck/fields.hpp"

namespace fissura::deck {
namespace {

using model::JointInertia;
using model::OutputSpec;
using model::RunSpec;
using units::Dimension;
using Written = std::optional<std::string>;

void finish_run(Reader& reader, Node const&, void* record) {
  auto const& run = *static_cast<RunSpec const*>(record);
  if (reader.good(record, {"residual_warn", "residual_stop"}) && run.residual_stop < run.residual_warn)
    reader.error(reader.place(record, "residual_stop"),
                 "`residual_stop` must not be less than `residual_warn`");
}

void read_joint_inertia(Reader& r, Node const& n, Key const& k, RunSpec& run) {
  if (n.kind == Node::Kind::text) {
    if (!read_word(r, n, k, {"automatic"}))
      r.error(n, fmt::format("`{}` may also be `true` or `false`, without quotation marks", k.name));
    return;
  }
  if (auto const on = read_flag(r, n, k)) run.joint_inertia = *on ? JointInertia::on : JointInertia::off;
}

Written write_joint_inertia(RunSpec const& run) {
  if (run.joint_inertia == JointInertia::automatic) return write_text("automatic");
  return write_flag(run.joint_inertia == JointInertia::on);
}

Section run_section() {
  Section s = single_section("run", &model::Case::run, "The run as a whole.");
  s.finish = finish_run;
  Fields<RunSpec> f(s.keys);
  f.quantity("end_time", &RunSpec::end_time, Dimension::time,
             "End of the run; 0: the sum of the stages. Required without stages.")
      .not_negative();
  f.number("dt_factor", &RunSpec::dt_factor,
           "The time step over the stable one. Above 0.86 joints that open and close may gain energy.")
      .range({0, 1, true, false});
  f.quantity("dt", &RunSpec::dt, Dimension::time, "A fixed time step; 0: from the stable one.")
      .not_negative();
  f.quantity("least_dt", &RunSpec::least_dt, Dimension::time,
             "Selective mass scaling: tets with a smaller step get the mass that lifts it to this; 0: none.")
      .not_negative();
  f.custom("joint_inertia", "`automatic`, `true` or `false`",
           "The copies of a point get inertia against each other, so that joints do not set the time step: 4 "
           "to 12 times longer steps for slow loading. Not for waves, impact and spalling. Automatic: unless "
           "loads come so fast that cracks would be late, or there are impactors, planes, initial "
           "velocities, absorbing boundaries, a `rate_factor`, local "
           "damping, `dt` or `least_dt`.",
           read_joint_inertia, write_joint_inertia);
  f.quantity("mass_damping", &RunSpec::mass_damping, Dimension::rate, "c of F = -c m v.").not_negative();
  f.number("local_damping", &RunSpec::local_damping, "alpha of F = -alpha |f| sign(v): dynamic relaxation.")
      .range({0, 1, false, true});
  f.integer("threads", &RunSpec::threads, "Threads; 0: all. The result does not depend on it.")
      .range({0, 1024});
  f.integer("max_steps", &RunSpec::max_steps, "Stops after so many steps; 0: no limit.").range({0, 1e15});
  f.integer("energy_every", &RunSpec::energy_every, "Steps between two readings of the energy ledger.")
      .range({1, 1e9})
      .default_is("50; 10 with `joint_inertia`")
      .echoed_if([](RunSpec const& run) { return run.energy_every > 0; });
  f.number("residual_warn", &RunSpec::residual_warn, "Energy residual that warns.").positive();
  f.number("residual_stop", &RunSpec::residual_stop, "Energy residual that stops the run.").positive();
  f.number(
       "pace", &RunSpec::pace,
       "Quasi-static pace control: the loads follow their curves up to so many times faster, as far as "
       "`pace_kinetic` allows, and more slowly while it cracks. Durations and curves are then in the time of "
       "the loads. 1: off. Only for loading in which inertia should not matter.")
      .range({1, 1000});
  f.number("pace_kinetic", &RunSpec::pace_kinetic,
           "Kinetic over internal energy that the pace control aims at.")
      .range({0, 1, true, false});
  return s;
}

Section output_section() {
  Section s = single_section("output", &model::Case::output, "What is written, and how often.");
  Fields<OutputSpec> f(s.keys);
  f.integer("history_points", &OutputSpec::history_points, "Rows of history.csv over the run, about.")
      .range({1, 1e7});
  f.quantity("history_every", &OutputSpec::history_every, Dimension::time,
             "Time between rows; > 0 wins over `history_points`.")
      .not_negative();
  f.integer("frames", &OutputSpec::frames,
            "Frames of fields, cracks, bars and surface over the run, about; 0: none.")
      .range({0, 1e5});
  f.quantity("frames_every", &OutputSpec::frames_every, Dimension::time,
             "Time between frames; > 0 wins over `frames`.")
      .not_negative();
  f.flag(
      "surface", &OutputSpec::surface,
      "Frames also of the surface of the body and of its cracks, `surface.pvd`: small files for pictures.");
  f.quantity("checkpoint_every", &OutputSpec::checkpoint_every, Dimension::time,
             "Wall time between two checkpoints; 0: none by time.")
      .not_negative();
  f.integer("checkpoint_steps", &OutputSpec::checkpoint_steps,
            "Steps between two checkpoints; 0: none by steps.")
      .range({0, 1e15});
  f.integer("hash_every", &OutputSpec::hash_every,
            "Steps between two hashes of the state in log.txt; 0: none.")
      .range({0, 1e15});
  f.number("magnify", &OutputSpec::magnify, "Scale of the displacements in pictures; no effect on the run.")
      .range({0, 1e6});
  return s;
}

} // namespace

std::vector<Section> run_sections() {
  return {run_section(), output_section()};
}

} // namespace fissura::deck
