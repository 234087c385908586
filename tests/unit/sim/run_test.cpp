// What a run leaves behind, and what it refuses to touch.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "fissura/contact/rigid_shape.hpp"
#include "fissura/sim/fields.hpp"
#include "fissura/sim/run.hpp"
#include "support/cases.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::support {
namespace {

namespace fs = std::filesystem;
using output::testing::read_bytes;
using output::testing::TemporaryFolder;

model::Case small_tie() {
  auto c = tie_case({4, 1, 1}, 6e-4, 1);
  auto f = gauge("force", model::GaugeSpec::Kind::reaction);
  f.of = {"pull"};
  auto u = gauge("u", model::GaugeSpec::Kind::displacement);
  u.where = plane(0, 0.6);
  c.gauges = {f, u};
  c.output.frames = 3;
  c.output.history_points = 20;
  return c;
}

sim::RunOptions options_for(std::string const& out) {
  sim::RunOptions o;
  o.out = out;
  o.deck_echo = "title = \"test\"\n";
  o.version = "1.2.3";
  o.quiet = true;
  o.threads = 1;
  return o;
}
nlohmann::json summary(std::string const& folder) {
  return nlohmann::json::parse(read_bytes(folder + "/run.json"));
}

std::vector<std::string> lines_of(std::string const& path) {
  std::istringstream in(read_bytes(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}
std::vector<std::string> cells_of(std::string const& line) {
  std::istringstream in(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}
/// Readings of one column.
std::vector<double> column(std::vector<std::string> const& lines, std::string const& name) {
  auto const header = cells_of(lines[0]);
  auto const where = std::find(header.begin(), header.end(), name) - header.begin();
  std::vector<double> values;
  for (std::size_t i = 1; i < lines.size(); ++i)
    values.push_back(std::stod(cells_of(lines[i])[static_cast<std::size_t>(where)]));
  return values;
}
core::Failure failure_of(model::Case const& c, sim::RunOptions const& o) {
  try {
    sim::run_case(c, o);
  } catch (core::Error const& e) {
    return e.failure;
  }
  ADD_FAILURE() << "no error";
  return core::Failure::run;
}

// Requirement: where there are rigid bodies, their surfaces are written as frames with the displacement they
// have, and run.json tells how they ended.
TEST(RunFolder, shows_rigid_bodies) {
  TemporaryFolder const folder;
  auto c = small_tie();
  c.planes = {{{}, "floor", {0, 0, -1}, {0, 0, 1}, 0.6}};
  model::ImpactorSpec ball;
  ball.name = "ball", ball.centre = {0, 0, 2}, ball.radius = 0.5, ball.mass = 3, ball.velocity = {0, 0, -7};
  auto rod = ball, crate = ball;
  rod.name = "rod", rod.shape = model::ImpactorSpec::Shape::cylinder, rod.from = {0, 3, 2},
  rod.to = {1, 4, 2};
  crate.name = "crate", crate.shape = model::ImpactorSpec::Shape::box, crate.from = {9, 9, 9},
  crate.to = {8, 7, 6};
  c.impactors = {ball, rod, crate};
  sim::run_case(c, options_for(folder / "run"));
  EXPECT_TRUE(fs::is_regular_file(folder / "run/rigid.pvd"));
  EXPECT_TRUE(fs::is_regular_file(folder / "run/frames/rigid_00000.vtu"));
  auto const j = summary(folder / "run");
  ASSERT_EQ(j["rigid_bodies"].size(), 4u);
  EXPECT_EQ(j["rigid_bodies"][1]["name"], "ball");
  EXPECT_NEAR(j["rigid_bodies"][1]["displacement"][2].get<double>(), -7 * j["time"].get<double>(), 1e-12);
  EXPECT_FALSE(j["rigid_bodies"][0].contains("mass"));

  Stepper const x(c);
  auto const g = sim::rigid_grid(x.m, x.s);
  ASSERT_EQ(g.points.size(), 3 * g.types.size());
  for (std::size_t i = 0; i < g.points.size(); ++i) {
    auto const body = std::get<std::vector<std::int32_t>>(g.cell_data[0].values)[i / 3];
    auto const& b = x.m.rigid[static_cast<std::size_t>(body)];
    double const off = std::abs(contact::distance(b, g.points[i]).value);
    EXPECT_LE(off, 1e-12) << "a corner of a facet lies off the surface of " << b.name;
  }
}

// Requirement: a run folder holds every file that other tools rely on, and run.json every key.
TEST(RunFolder, is_complete) {
  TemporaryFolder const folder;
  auto const result = sim::run_case(small_tie(), options_for(folder / "run"));
  EXPECT_EQ(result.status, "complete");
  EXPECT_EQ(result.folder, folder / "run");
  for (char const* file :
       {"run.json", "history.csv", "fields.pvd", "cracks.pvd", "bars.pvd", "log.txt", "case.toml"})
    EXPECT_TRUE(fs::is_regular_file(folder / "run/" + file)) << file;
  EXPECT_EQ(read_bytes(folder / "run/case.toml"), "title = \"test\"\n");
  auto const j = summary(folder / "run");
  for (char const* key : {"status",
                          "reason",
                          "version",
                          "threads",
                          "tets",
                          "joints",
                          "bar_elements",
                          "bar_joints",
                          "dt",
                          "steps",
                          "time",
                          "wall_seconds",
                          "tet_steps_per_second",
                          "joints_damaged",
                          "joints_broken",
                          "bar_joints_activated",
                          "bar_joints_yielded",
                          "bars_broken",
                          "fragments",
                          "energy",
                          "energy_residual",
                          "max_kinetic_ratio",
                          "state_hash",
                          "stable_dt_limiter"})
    EXPECT_TRUE(j.contains(key)) << key;
  EXPECT_EQ(j["status"], "complete");
  EXPECT_EQ(j["version"], "1.2.3");
  EXPECT_EQ(j["threads"], 1);
  EXPECT_EQ(j["tets"], 24);
  EXPECT_GE(j["time"].get<double>(), 6e-4);
  EXPECT_NEAR(j["time"].get<double>(), j["steps"].get<double>() * j["dt"].get<double>(), 1e-15);
  EXPECT_EQ(j["state_hash"].get<std::string>().size(), 16u);
  EXPECT_EQ(j["energy"].size(), 22u);
}

// Requirement: the collections name one file per frame, each of which exists and was drawn at its time.
TEST(RunFolder, collections_name_existing_frames) {
  TemporaryFolder const folder;
  sim::run_case(small_tie(), options_for(folder / "run"));
  for (char const* name : {"fields", "cracks", "bars"}) {
    std::string const text = read_bytes(folder / "run/" + name + ".pvd");
    int frames = 0;
    for (std::size_t at = text.find("file=\""); at != std::string::npos; at = text.find("file=\"", at + 1)) {
      std::size_t const from = at + 6;
      std::string const file = text.substr(from, text.find('"', from) - from);
      EXPECT_TRUE(fs::is_regular_file(folder / "run/" + file)) << file;
      ++frames;
    }
    EXPECT_EQ(frames, 4) << name; // 0, 1/3, 2/3 and the end
  }
}

// Requirement: history.csv begins with time, the gauges with their units and the reactions, then the energies
// and counts; it has about as many rows as asked for, in rising time.
TEST(RunFolder, history_has_its_columns) {
  TemporaryFolder const folder;
  sim::run_case(small_tie(), options_for(folder / "run"));
  auto const lines = lines_of(folder / "run/history.csv");
  auto const header = cells_of(lines.at(0));
  ASSERT_GT(header.size(), 7u);
  EXPECT_EQ(header[0], "time [s]");
  EXPECT_EQ(header[1], "force [N]");
  EXPECT_EQ(header[2], "u [m]");
  EXPECT_EQ(header[3], "reaction_left_x [N]");
  EXPECT_EQ(header[6], "reaction_pull_x [N]");
  EXPECT_EQ(header[7], "energy_kinetic [J]");
  for (char const* name : {"energy_residual [-]", "joints_damaged [-]", "joints_broken [-]",
                           "bar_joints_activated [-]", "bar_joints_yielded [-]", "bars_broken [-]"})
    EXPECT_NE(std::find(header.begin(), header.end(), name), header.end()) << name;
  EXPECT_GE(lines.size(), 20u);
  EXPECT_LE(lines.size(), 23u);
  for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_EQ(cells_of(lines[i]).size(), header.size());
  auto const time = column(lines, "time [s]");
  EXPECT_EQ(time[0], 0);
  EXPECT_TRUE(std::is_sorted(time.begin(), time.end()));
  EXPECT_EQ(column(lines, "force [N]"), column(lines, "reaction_pull_x [N]"));
}

// Requirement: what a gauge reports at a time belongs to that time: the pulled end is where its ramp has
// brought it.
TEST(RunFolder, history_rows_belong_to_their_time) {
  auto c = small_tie();
  c.motions[0] = motion_at("pull", plane(0, 0.6), 0, ramp(1e-5, 6e-4));
  TemporaryFolder const folder;
  sim::run_case(c, options_for(folder / "run"));
  auto const lines = lines_of(folder / "run/history.csv");
  auto const time = column(lines, "time [s]"), u = column(lines, "u [m]");
  for (std::size_t i = 0; i < time.size(); ++i) {
    double const x = time[i] / 6e-4, s = x * x * x * (10 + x * (6 * x - 15));
    EXPECT_NEAR(u[i], 1e-5 * s, 1e-15);
  }
}

// Requirement: two runs of one case give the same history, to the byte, also on different numbers of threads.
TEST(RunFolder, history_is_reproducible) {
  TemporaryFolder const folder;
  auto o = options_for(folder / "one");
  sim::run_case(small_tie(), o);
  o.out = folder / "two";
  o.threads = 3;
  sim::run_case(small_tie(), o);
  EXPECT_EQ(read_bytes(folder / "one/history.csv"), read_bytes(folder / "two/history.csv"));
  EXPECT_EQ(summary(folder / "one")["state_hash"], summary(folder / "two")["state_hash"]);
  EXPECT_EQ(summary(folder / "two")["threads"], 3);
}

// Requirement: an existing run folder is refused as an I/O failure and left as it was; --force replaces it.
TEST(RunFolder, is_never_overwritten_without_force) {
  TemporaryFolder const folder;
  auto o = options_for(folder / "run");
  sim::run_case(small_tie(), o);
  std::string const before = read_bytes(folder / "run/run.json");
  EXPECT_EQ(failure_of(small_tie(), o), core::Failure::io);
  EXPECT_EQ(read_bytes(folder / "run/run.json"), before);
  o.force = true;
  auto longer = small_tie();
  longer.run.end_time *= 2;
  EXPECT_EQ(sim::run_case(longer, o).status, "complete");
  EXPECT_GT(summary(folder / "run")["steps"], nlohmann::json::parse(before)["steps"]);
}

// Requirement: --force keeps files that are not its own.
TEST(RunFolder, force_keeps_foreign_files) {
  TemporaryFolder const folder;
  auto o = options_for(folder / "run");
  sim::run_case(small_tie(), o);
  std::ofstream(folder / "run/notes.txt") << "mine";
  o.force = true;
  sim::run_case(small_tie(), o);
  EXPECT_EQ(read_bytes(folder / "run/notes.txt"), "mine");
}

// Requirement: a folder that cannot be made is an I/O failure that names it.
TEST(RunFolder, that_cannot_be_made_is_an_io_failure) {
  TemporaryFolder const folder;
  std::ofstream(folder / "file") << "in the way";
  EXPECT_EQ(failure_of(small_tie(), options_for(folder / "file/run")), core::Failure::io);
}

// ---- how runs end
// ------------------------------------------------------------------------------------------------

// Requirement: a time step far too large ends the run as failed: no exception, a reason with the time, and a
// folder that tells so.
TEST(RunEnds, failed_with_a_reason) {
  auto c = small_tie();
  Stepper const x(c);
  c.run.dt = 5 * x.m.dt;
  TemporaryFolder const folder;
  auto const result = sim::run_case(c, options_for(folder / "run"));
  EXPECT_EQ(result.status, "failed");
  EXPECT_NE(result.reason.find("t = "), std::string::npos) << result.reason;
  EXPECT_EQ(summary(folder / "run")["status"], "failed");
  EXPECT_EQ(summary(folder / "run")["reason"], result.reason);
  EXPECT_NE(read_bytes(folder / "run/log.txt").find("failed"), std::string::npos);
}

// Requirement: where numbers stop being finite the reason names the tet, its group and its place.
TEST(RunEnds, failed_naming_the_place_of_a_nan) {
  auto c = small_tie();
  Stepper const x(c);
  c.run.dt = 20 * x.m.dt;
  c.run.end_time = 6e-3;
  c.run.energy_every = 1000000; // the ledger looks only when a row of the history is due
  c.output.history_points = 2;
  TemporaryFolder const folder;
  auto const result = sim::run_case(c, options_for(folder / "run"));
  EXPECT_EQ(result.status, "failed");
  EXPECT_NE(result.reason.find("no longer finite"), std::string::npos) << result.reason;
  EXPECT_NE(result.reason.find("of tet "), std::string::npos) << result.reason;
  EXPECT_NE(result.reason.find("of group concrete at ("), std::string::npos) << result.reason;
}

// Requirement: a stop condition, max_steps and --until end the run early, each with its reason and a full
// folder.
TEST(RunEnds, early_with_the_reason) {
  TemporaryFolder const folder;
  auto c = small_tie();
  model::StopSpec stop;
  stop.gauge = "u", stop.has_above = true, stop.above = 1e-4;
  c.stops = {stop};
  auto const met = sim::run_case(c, options_for(folder / "met"));
  EXPECT_NE(met.status, "failed");
  EXPECT_NE(met.reason.find("u = "), std::string::npos);
  auto const u = column(lines_of(folder / "met/history.csv"), "u [m]");
  EXPECT_GT(u.back(), 1e-4);
  EXPECT_LT(u[u.size() - 2], 1e-4);

  c = small_tie();
  c.run.max_steps = 17;
  EXPECT_EQ(sim::run_case(c, options_for(folder / "steps")).status, "stopped");
  EXPECT_EQ(summary(folder / "steps")["steps"], 17);

  auto o = options_for(folder / "until");
  o.until = 2e-4;
  EXPECT_EQ(sim::run_case(small_tie(), o).status, "stopped");
  EXPECT_NEAR(summary(folder / "until")["time"].get<double>(), 2e-4,
              2 * summary(folder / "until")["dt"].get<double>());
}

// ---- stages
// ------------------------------------------------------------------------------------------------------

/// A bonded prism hung up at x = 0 in a stage `rest`, then pulled in a stage `pull` of 3 ms.
model::Case two_stages(double gravity_ramp) {
  auto c = box_case({2, 1, 1}, {0.2, 0.1, 0.1}, 0);
  c.concretes[0].joints = false;
  c.supports = {support_at("base", plane(0, 0), {true, true, true})};
  c.gravity.on = true;
  c.gravity.stage = "rest";
  c.gravity.direction = {1, 0, 0};
  c.gravity.curve = ramp(9.81, gravity_ramp);
  c.motions = {motion_at("pull", plane(0, 0.2), 0, ramp(2e-6, 2e-3))};
  c.motions[0].stage = "pull";
  model::StageSpec rest, pull;
  rest.name = "rest", rest.duration = 1, rest.mass_damping = 8000, rest.settle = 1e-3;
  pull.name = "pull", pull.duration = 3e-3;
  c.stages = {rest, pull};
  auto u = gauge("u", model::GaugeSpec::Kind::displacement);
  u.where = plane(0, 0.2);
  u.zero_at = "pull";
  auto r = gauge("weight", model::GaugeSpec::Kind::reaction);
  r.of = {"base"};
  c.gauges = {u, r};
  c.output.history_every = 1e-4;
  c.output.frames = 1;
  return c;
}
double const hung_weight = 2500 * 0.2 * 0.1 * 0.1 * 9.81;

// Requirement: a stage that has settled ends early and brings the end of the run forward; motions start with
// their stage, and gauges zeroed there read from then on.
TEST(Stages, follow_one_another) {
  TemporaryFolder const folder;
  auto const result = sim::run_case(two_stages(1e-3), options_for(folder / "run"));
  EXPECT_EQ(result.status, "complete") << result.reason;
  EXPECT_LT(summary(folder / "run")["time"].get<double>(), 0.02) << "`rest` ended early, so the run should";
  EXPECT_NE(read_bytes(folder / "run/log.txt").find("stage `pull` begins"), std::string::npos);
  auto const lines = lines_of(folder / "run/history.csv");
  auto const u = column(lines, "u [m]"), time = column(lines, "time [s]"),
             reaction = column(lines, "weight [N]");
  EXPECT_NEAR(u.back(), 2e-6, 1e-8);
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] > 0.95e-3 && time[i] < 1.05e-3) {
      EXPECT_NEAR(reaction[i], -hung_weight, 0.1 * hung_weight);
    }
  }
}

// Requirement: a stage begins in the step in which its time has come, however seldom the ledger is read.
TEST(Stages, begin_at_their_time) {
  auto c = tie_case({4, 1, 1}, 0, 1);
  c.run.energy_every = 1'000'000;
  for (double const duration : {1e-4, 3e-4}) {
    model::StageSpec stage;
    stage.duration = duration;
    c.stages.push_back(stage);
  }
  sim::RunOptions o;
  o.quiet = true, o.threads = 1;
  sim::Run run(c, o);
  run.open();
  while (run.step()) {
  }
  double const dt = run.model().dt, begin = run.state().stage_start[1];
  EXPECT_GE(begin, 1e-4);
  EXPECT_LE(begin, 1e-4 + dt * 1.001);
  EXPECT_LE(run.state().time, begin + 3e-4 + 2 * dt);
}

// Requirement: a stage does not count as settled while one of its loads is still growing, however slowly.
TEST(Stages, do_not_settle_while_loads_grow) {
  TemporaryFolder const folder;
  sim::run_case(two_stages(2e-2), options_for(folder / "run"));
  EXPECT_GE(summary(folder / "run")["time"].get<double>(), 2.3e-2);
  auto const lines = lines_of(folder / "run/history.csv");
  auto const time = column(lines, "time [s]"), reaction = column(lines, "weight [N]");
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] > 1.9e-2 && time[i] < 2e-2) {
      EXPECT_NEAR(reaction[i], -hung_weight, 0.02 * hung_weight);
    }
  }
}

// Requirement: with an end time in the deck, settling does not shorten the run.
TEST(Stages, an_end_time_in_the_deck_holds) {
  auto c = two_stages(1e-3);
  c.run.end_time = 1e-2;
  TemporaryFolder const folder;
  sim::run_case(c, options_for(folder / "run"));
  EXPECT_NEAR(summary(folder / "run")["time"].get<double>(), 1e-2, 1e-4);
}

/// A bonded prism pulled at both ends to 1e-5 of mean strain, back to zero force, and to 2e-5.
model::Case pulled_to_and_fro() {
  auto c = box_case({4, 1, 1}, {0.4, 0.1, 0.1}, 1);
  c.concretes[0].joints = false;
  c.run.energy_every = 5; // gauges are read as often
  c.supports = {support_at("guide", plane(1, 0), {false, true, false})};
  auto right = motion_at("right", plane(0, 0.4), 0, {}, true),
       left = motion_at("left", plane(0, 0), 0, {}, true);
  right.path.emplace();
  right.path->speed = 2e-3, right.path->turn = 1e-3;
  right.path->targets = {{{}, "strain", 1e-5, ""}, {{}, "force", 0, ""}, {{}, "strain", 2e-5, ""}};
  left.path.emplace();
  left.path->of = "right", left.path->scale = -1;
  c.motions = {right, left};
  auto strain = gauge("strain", model::GaugeSpec::Kind::mean_strain);
  strain.to = {0.4, 0, 0};
  auto force = gauge("force", model::GaugeSpec::Kind::reaction);
  force.of = {"right"};
  c.gauges = {strain, force};
  c.output.frames = 1;
  c.output.history_every = 2e-5;
  return c;
}

// Requirement: a path turns at its targets (within the overshoot of its turn and one beat), both ends pull
// alike, and the run is complete after the last target and says so.
TEST(Paths, follow_their_gauges) {
  TemporaryFolder const folder;
  auto const result = sim::run_case(pulled_to_and_fro(), options_for(folder / "run"));
  EXPECT_EQ(result.status, "complete");
  EXPECT_EQ(result.reason.find("path of `right`: target 3 of 3 reached, strain = "), 0U) << result.reason;
  auto const lines = lines_of(folder / "run/history.csv");
  auto const strain = column(lines, "strain [-]"), force = column(lines, "force [N]"),
             left = column(lines, "reaction_left_x [N]");
  std::vector<double> turning;
  for (std::size_t i = 1; i + 1 < strain.size(); ++i)
    if ((strain[i] - strain[i - 1]) * (strain[i + 1] - strain[i]) < 0) turning.push_back(strain[i]);
  double const over = 2 * 2e-3 * (0.35 * 1e-3 + 1e-4) / 0.4, ripple = 0.03 * 2e-5; // of the force, see below
  ASSERT_EQ(turning.size(), 2U);
  EXPECT_NEAR(turning[0], 1e-5 + 0.5 * over, 0.5 * over);
  EXPECT_NEAR(turning[1], -0.5 * over, 0.5 * over + ripple);
  double const stiffness = plain_concrete().E * 0.01;
  for (std::size_t i = 0; i < strain.size(); ++i) {
    EXPECT_NEAR(force[i], stiffness * strain[i], stiffness * ripple);
    EXPECT_NEAR(force[i], -left[i], 1e-3 * stiffness * 2e-5); // the cells are not mirrored
  }
}

// Requirement: output settings change no result of a run that is steered by gauges, to the last bit, with a
// gauge that is zeroed at a stage among them.
TEST(Paths, do_not_depend_on_output) {
  auto c = pulled_to_and_fro();
  model::StageSpec wait, pull;
  wait.name = "wait", wait.duration = 1e-4;
  pull.name = "pull", pull.duration = 1;
  c.stages = {wait, pull};
  c.run.end_time = 0;
  c.motions[0].stage = "pull";
  c.gauges[0].zero_at = "pull";
  TemporaryFolder const folder;
  std::vector<std::string> hashes;
  for (double const every : {2e-5, 3.3e-4}) {
    c.output.history_every = every;
    auto const run = folder / fmt::format("run{}", hashes.size());
    sim::run_case(c, options_for(run));
    hashes.push_back(summary(run)["state_hash"].get<std::string>());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

// Requirement: a path that is told to rest holds its last position while the run goes on.
TEST(Paths, may_come_to_rest) {
  auto c = pulled_to_and_fro();
  c.motions[0].path->stops = false;
  c.run.end_time = 0.02;
  TemporaryFolder const folder;
  auto const result = sim::run_case(c, options_for(folder / "run"));
  EXPECT_EQ(result.reason, "end time reached");
  auto const strain = column(lines_of(folder / "run/history.csv"), "strain [-]");
  EXPECT_NEAR(strain.back(), 2e-5, 2 * 2e-3 * (0.7 * 1e-3 + 1e-4) / 0.4);
  EXPECT_NEAR(strain.back(), strain[strain.size() - 20], 1e-12);
}

// Requirement: the log says when the energy residual passes its warning level, once and as it happens.
TEST(Run, warns_as_the_residual_passes_its_level) {
  TemporaryFolder folder;
  auto c = small_tie();
  c.run.residual_warn = 1e-14;
  auto options = options_for(folder / "run");
  sim::Run run(c, options);
  run.open();
  while (run.step()) {
  }
  run.finish();
  int passes = 0, first = 0, n = 0, end = 0;
  for (auto const& line : lines_of(options.out + "/log.txt")) {
    ++n;
    if (line.find("the energy residual passes") != std::string::npos) ++passes, first = n;
    if (line.find("complete: ") != std::string::npos) end = n;
  }
  EXPECT_EQ(passes, 1);
  EXPECT_LT(first, end);
}

} // namespace
} // namespace fissura::support
