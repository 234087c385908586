// Runs that are over and are gone on with: longer, with other gauges, other stop conditions, other output.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "fissura/checkpoint/store.hpp"
#include "fissura/core/error.hpp"
#include "fissura/deck/deck.hpp"
#include "fissura/sim/identity.hpp"
#include "fissura/sim/run.hpp"
#include "support/cases.hpp"
#include "support/refusal.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::support {
namespace {

namespace fs = std::filesystem;
using output::testing::read_bytes;
using output::testing::TemporaryFolder;

/// A tie that cracks, with equal intervals whatever its end.
model::Case tie(double end_time) {
  auto c = tie_case({4, 1, 1}, end_time, 1);
  auto f = gauge("force", model::GaugeSpec::Kind::reaction);
  f.of = {"pull"};
  auto u = gauge("u", model::GaugeSpec::Kind::displacement);
  u.where = plane(0, 0.6);
  c.gauges = {f, u};
  c.output.history_every = 2e-5, c.output.frames_every = 1e-4;
  return c;
}
model::StopSpec above(std::string gauge, double value) {
  model::StopSpec s;
  s.place = {"case.toml", 50, 1};
  s.gauge = std::move(gauge), s.has_above = true, s.above = value;
  return s;
}

sim::RunOptions options(std::string const& out, bool goes_on = false) {
  sim::RunOptions o;
  o.out = out, o.deck_echo = "x", o.version = "1", o.quiet = true, o.threads = 1;
  if (goes_on) o.restart = out;
  return o;
}
sim::RunResult run(model::Case const& c, std::string const& out) {
  return sim::run_case(c, options(out));
}
sim::RunResult go_on(model::Case const& c, std::string const& out) {
  return sim::run_case(c, options(out, true));
}
std::string refusal(model::Case const& c, std::string const& out) {
  return support::refusal(core::Failure::input, [&] { go_on(c, out); });
}

nlohmann::json summary(std::string const& folder) {
  auto j = nlohmann::json::parse(read_bytes(folder + "/run.json"));
  for (char const* of_the_machine : {"wall_seconds", "tet_steps_per_second"}) j.erase(of_the_machine);
  return j;
}

/// Name by name the same bytes: the history, the lists, the frames; and run.json but for the wall time.
void expect_same_run(std::string const& one, std::string const& two) {
  EXPECT_EQ(summary(one), summary(two));
  std::size_t frames = 0;
  for (auto const& entry : fs::recursive_directory_iterator(one)) {
    auto const name = fs::relative(entry.path(), one).string();
    auto const ending = entry.path().extension();
    if (ending != ".csv" && ending != ".pvd" && ending != ".vtu") continue;
    frames += ending == ".vtu";
    ASSERT_TRUE(fs::exists(fs::path(two) / name)) << name;
    EXPECT_EQ(read_bytes(entry.path().string()), read_bytes((fs::path(two) / name).string())) << name;
  }
  EXPECT_GT(frames, 0U);
  auto const count = [](std::string const& run) {
    return std::distance(fs::directory_iterator(run + "/frames"), fs::directory_iterator());
  };
  EXPECT_EQ(count(one), count(two));
}

std::vector<std::string> column(std::string const& folder, std::string const& title) {
  std::istringstream in(read_bytes(folder + "/history.csv"));
  std::vector<std::string> values;
  std::size_t at = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (values.empty()) at = static_cast<std::size_t>(std::find(row.begin(), row.end(), title) - row.begin());
    values.push_back(at < row.size() ? row[at] : "no such column");
  }
  values.erase(values.begin());
  return values;
}

// Requirement: a run that is complete, prolonged twice, ends in the files and the state of one that was made
// at once.
TEST(ProlongedRun, ends_as_the_run_made_at_once) {
  TemporaryFolder const folder;
  run(tie(1.2e-3), folder / "whole");
  EXPECT_EQ(run(tie(4e-4), folder / "parts").status, "complete");
  EXPECT_EQ(go_on(tie(7e-4), folder / "parts").status, "complete");
  EXPECT_EQ(go_on(tie(1.2e-3), folder / "parts").status, "complete");
  EXPECT_GT(summary(folder / "whole")["joints_damaged"], 0);
  expect_same_run(folder / "whole", folder / "parts");
}

// Requirement: going on with a run that is over, with nothing changed, changes nothing: whether time, a stop
// condition or a path has ended it.
TEST(ProlongedRun, that_is_not_prolonged_stays_as_it_is) {
  TemporaryFolder const folder;
  auto stopped = tie(1.2e-3);
  stopped.stops = {above("u", 1e-4)};
  for (auto const& [name, c] : {std::pair{"ended", tie(4e-4)}, {"stopped", stopped}}) {
    run(c, folder / name);
    fs::copy(folder / name, folder / (std::string(name) + "_before"), fs::copy_options::recursive);
    auto const result = go_on(c, folder / name);
    EXPECT_EQ(result.status, "complete");
    EXPECT_EQ(result.reason, summary(folder / (std::string(name) + "_before"))["reason"]);
    expect_same_run(folder / (std::string(name) + "_before"), folder / name);
  }
}

// Requirement: a run that a stop condition has ended goes on once the condition is raised or gone, and ends
// as if it had been so from the start; a later end alone does not wake it.
TEST(ProlongedRun, goes_on_behind_a_stop) {
  TemporaryFolder const folder;
  auto first = tie(1.2e-3), second = tie(1.2e-3);
  first.stops = {above("u", 1e-4)};
  second.stops = {above("u", 3e-4)};
  run(second, folder / "whole");
  ASSERT_EQ(run(first, folder / "parts").reason.find("u = 0.1"), 0U);
  auto later = first;
  later.run.end_time = 2e-3;
  EXPECT_EQ(go_on(later, folder / "parts").reason, summary(folder / "parts")["reason"]);
  EXPECT_EQ(summary(folder / "parts")["reason"].get<std::string>().find("u = 0.1"), 0U);
  EXPECT_EQ(go_on(second, folder / "parts").reason.find("u = 0.3"), 0U);
  expect_same_run(folder / "whole", folder / "parts");
  go_on(tie(1.2e-3), folder / "parts");
  run(tie(1.2e-3), folder / "free");
  expect_same_run(folder / "free", folder / "parts");
}

// Requirement: a condition that the rows so far have met already is refused at its place, and one that falls
// from a peak knows the peak from before it was there.
TEST(ProlongedRun, new_stops_look_back) {
  TemporaryFolder const folder;
  run(tie(2.4e-4), folder / "run"); // near the peak of the force
  auto c = tie(1.2e-3);
  c.stops = {above("u", 1e-6)};
  std::string const text = refusal(c, folder / "run");
  EXPECT_EQ(text.find("case.toml:50:1: error: [[stop]]: u = "), 0U) << text;
  EXPECT_NE(text.find("before the checkpoint: the run would have ended there"), std::string::npos) << text;
  model::StopSpec falls;
  falls.gauge = "force", falls.falls_to = 0.9, falls.after = 1;
  c.stops = {falls};
  auto const at_once = run(c, folder / "whole");
  EXPECT_NE(at_once.reason.find("has fallen below"), std::string::npos);
  auto const second = go_on(c, folder / "run");
  EXPECT_EQ(second.reason, at_once.reason);
  expect_same_run(folder / "whole", folder / "run");
}

// Requirement: a gauge that is new reads nan in the rows before it was there, one that is gone leaves the
// file, one that stays keeps every digit; so does a gauge of the same name that reads something else.
TEST(ProlongedRun, takes_other_gauges) {
  TemporaryFolder const folder;
  run(tie(4e-4), folder / "run");
  run(tie(8e-4), folder / "whole");
  auto c = tie(8e-4);
  auto far = c.gauges[1];
  far.name = "far", far.factor = 2;
  c.gauges = {far, c.gauges[1]};
  c.gauges[1].factor = -1; // `u` by name, but another
  go_on(c, folder / "run");
  auto const rows = column(folder / "whole", "u [m]"), mirrored = column(folder / "run", "u [m]"),
             doubled = column(folder / "run", "far [m]"), times = column(folder / "whole", "time [s]");
  EXPECT_EQ(column(folder / "run", "force [N]").front(), "no such column");
  ASSERT_EQ(rows.size(), mirrored.size());
  ASSERT_EQ(rows.size(), doubled.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(mirrored[i] == "nan", doubled[i] == "nan");
    EXPECT_EQ(doubled[i] == "nan", std::stod(times[i]) < 4e-4) << i;
    if (doubled[i] == "nan") continue;
    EXPECT_EQ(std::stod(doubled[i]), 2 * std::stod(rows[i])) << i;
    EXPECT_EQ(std::stod(mirrored[i]), -std::stod(rows[i])) << i;
  }
  EXPECT_EQ(column(folder / "run", "reaction_pull_x [N]"), column(folder / "whole", "reaction_pull_x [N]"));
  EXPECT_EQ(summary(folder / "run")["state_hash"], summary(folder / "whole")["state_hash"]);
  // Once more, with the old gauges: those rows stay lost.
  go_on(tie(9e-4), folder / "run");
  EXPECT_EQ(column(folder / "run", "u [m]").front(), "nan");
  EXPECT_NE(column(folder / "run", "u [m]").back(), "nan");
}

// Requirement: a restart with other gauges that was killed once the history had been written anew goes on all
// the same.
TEST(ProlongedRun, survives_a_kill_behind_the_new_history) {
  TemporaryFolder const folder;
  run(tie(4e-4), folder / "run");
  fs::copy(folder / "run", folder / "killed", fs::copy_options::recursive);
  auto c = tie(8e-4);
  c.gauges.pop_back();
  go_on(c, folder / "run");
  // The history has the new columns and more rows than the checkpoint knows of.
  fs::copy(folder / "run/history.csv", folder / "killed/history.csv", fs::copy_options::overwrite_existing);
  go_on(c, folder / "killed");
  expect_same_run(folder / "run", folder / "killed");
}

// Requirement: what is written and how often may change, as may the title, the limits of the residual and the
// last stage; the log says what has changed.
TEST(ProlongedRun, takes_other_settings) {
  TemporaryFolder const folder;
  run(tie(4e-4), folder / "run");
  run(tie(8e-4), folder / "whole");
  auto c = tie(8e-4);
  c.title = "longer", c.run.residual_warn = 0.02, c.run.residual_stop = 0.1;
  c.output = {};
  c.output.history_every = 5e-5, c.output.frames = 0, c.output.magnify = 7;
  go_on(c, folder / "run");
  EXPECT_EQ(summary(folder / "run")["state_hash"], summary(folder / "whole")["state_hash"]);
  EXPECT_EQ(summary(folder / "run")["title"], "longer");
  std::string const log = read_bytes(folder / "run/log.txt");
  for (char const* change : {"changed since: [run] end_time = \"0.8 ms\" (was \"0.4 ms\")",
                             "[output] frames_every", "changed since: title = \"longer\" (was \"test\")"})
    EXPECT_NE(log.find(change), std::string::npos) << change << "\n" << log;
  auto const time = column(folder / "run", "time [s]");
  EXPECT_LT(time.size(), 0.8 * static_cast<double>(column(folder / "whole", "time [s]").size()));
  EXPECT_GE(std::stod(time.back()), 7.5e-4);
}

// Requirement: with stages the last one may become longer; an earlier one may not, and the refusal names it.
TEST(ProlongedRun, with_stages) {
  TemporaryFolder const folder;
  auto const with = [](double first, double last) {
    auto c = tie(0);
    c.motions[0].stage = "pull";
    model::StageSpec wait, pull;
    wait.name = "wait", wait.duration = first;
    pull.name = "pull", pull.duration = last;
    c.stages = {wait, pull};
    c.gauges[0].zero_at = "pull";
    return c;
  };
  run(with(1e-4, 3e-4), folder / "run");
  run(with(1e-4, 6e-4), folder / "whole");
  std::string const text = refusal(with(2e-4, 6e-4), folder / "run");
  EXPECT_NE(text.find("[[stage]] 1, duration = \"0.2 ms\" (was \"0.1 ms\")"), std::string::npos) << text;
  go_on(with(1e-4, 6e-4), folder / "run");
  expect_same_run(folder / "whole", folder / "run");
  auto c = with(1e-4, 8e-4);
  c.gauges[1].zero_at = "pull";
  EXPECT_NE(refusal(c, folder / "run").find("its zero is not known"), std::string::npos);
}

// Requirement: an end that the run has passed is refused; the very end it had is not.
TEST(ProlongedRun, cannot_be_made_shorter) {
  TemporaryFolder const folder;
  run(tie(4e-4), folder / "run");
  EXPECT_NE(
      refusal(tie(2e-4), folder / "run").find("the run is to end at 0.0002 s (the deck), and has come to "),
      std::string::npos);
  auto o = options(folder / "run", true);
  o.until = 1e-4;
  EXPECT_NE(support::refusal(core::Failure::input, [&] { sim::run_case(tie(4e-4), o); }).find("(--until)"),
            std::string::npos);
  EXPECT_EQ(go_on(tie(4e-4), folder / "run").status, "complete");
}

// Requirement: a run whose load was changed on the way is not gone on with as if the deck told its story.
TEST(ProlongedRun, of_changed_loads_is_refused) {
  TemporaryFolder const folder;
  sim::Run changed(tie(4e-4), options(folder / "run"));
  changed.open();
  ASSERT_TRUE(changed.step());
  changed.change_load("pull", "velocity", constant(0.1));
  while (changed.step()) {
  }
  changed.finish();
  EXPECT_NE(refusal(tie(8e-4), folder / "run").find("a program has changed a load in mid-run"),
            std::string::npos);
}

// Requirement: two echoes differ in the keys that are new, gone or other, each named with its item.
TEST(ChangedKeys, are_named) {
  std::string const was = "title = \"a\"\n\n[[bar]]\nd = 1\n\n[[bar]]\nd = 2\n\n[run]\nend = 3\n";
  std::string const is = "title = \"a\"\n\n[[bar]]\nd = 1\n\n[[bar]]\nd = 4\nn = 5\n\n[run]\n";
  auto const changes = sim::changed_keys(was, is);
  EXPECT_EQ(changes, (std::vector<std::string>{"[[bar]] 2, d = 4 (was 2)", "[[bar]] 2, n = 5 (was not there)",
                                               "[run] end is gone (was 3)"}));
  EXPECT_TRUE(sim::changed_keys(was, was).empty());
}

// Requirement: the echo of one item is its keys as they stand in the echo of the whole.
TEST(EchoOfAnItem, stands_in_the_echo) {
  auto const c = tie(1e-3);
  std::string const gauge = deck::echo_item(c, "gauge", 1);
  EXPECT_NE(gauge.find("name = \"u\""), std::string::npos);
  EXPECT_NE(deck::echo(c).find("\n[[gauge]]\n" + gauge), std::string::npos);
  EXPECT_EQ(deck::echo_item(c, "gauge", 2), "");
}

} // namespace
} // namespace fissura::support
