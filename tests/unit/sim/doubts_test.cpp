// What `check` says of cases that can be computed but are hardly meant.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fissura/sim/coarse_loads.hpp"
#include "fissura/sim/columns.hpp"
#include "fissura/sim/forecast.hpp"
#include "fissura/sim/guards.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/sim/progress.hpp"
#include "support/cases.hpp"

namespace fissura::support {
namespace {

sim::BuildReport report_of(model::Case const& c) {
  sim::BuildReport report;
  sim::build_model(c, report);
  return report;
}

bool any_says(std::vector<std::string> const& lines, std::string const& text) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](auto const& line) { return line.find(text) != std::string::npos; });
}

bool warns(model::Case const& c, std::string const& text) {
  return any_says(report_of(c).warnings, text);
}

std::string refusal_of(model::Case const& c) {
  try {
    report_of(c);
  } catch (core::InputError const& e) {
    return e.what();
  }
  return "none";
}

model::Case tie() {
  return tie_case({6, 2, 2}, 3e-3, 0.1);
}

// ---- names

// Requirement: a gauge may not have the name of a column of the program's own.
TEST(Names, OfColumnsAreTaken) {
  for (auto const* name : {"time", "joints_damaged", "energy_residual", "energy_kinetic", "reaction_pull_x",
                           "bars_broken", "load_time", "pace"}) {
    auto c = tie();
    c.gauges = {gauge(name, model::GaugeSpec::Kind::displacement)};
    EXPECT_EQ(refusal_of(c),
              "case.toml:40:1: error: the name \"" + std::string(name) +
                  "\" is taken: history.csv has a column of the program's own with it; give the "
                  "[[gauge]] another one");
  }
  auto c = tie();
  c.gauges = {gauge("times", model::GaugeSpec::Kind::displacement)};
  EXPECT_EQ(refusal_of(c), "none");
}

// ---- supports that share points

// Requirement: a foot held in all directions and a plane of symmetry may share points: the body moves to the
// last bit as if one of them held those, and the reaction there is booked once, to the first.
TEST(Supports, ThatAgreeMayShare) {
  auto c = box_case({4, 2, 2}, {0.4, 0.2, 0.2}, 1e-2);
  c.gravity.on = true, c.gravity.curve = ramp(9.81, 1e-3);
  auto apart = c;
  c.supports = {support_at("floor", plane(2, 0), {false, false, true}),
                support_at("corner", plane(0, 0), {true, true, true})};
  auto rest = box({1e-3, -1, -1}, {1, 1, 1e-3});
  apart.supports = {support_at("corner", plane(0, 0), {true, true, true}),
                    support_at("floor", rest, {false, false, true})};
  Stepper x(c), y(apart);
  x.advance(200), y.advance(200);
  for (int n = 0; n < node_count(x.m); ++n)
    for (int k = 0; k < 3; ++k) ASSERT_EQ(x.s.u(n, k), y.s.u(n, k));
  double together = 0, separate = 0;
  for (std::size_t i = 0; i < x.m.prescribed.size(); ++i)
    if (x.m.prescribed[i].axis == 2) together += x.s.reaction[i];
  for (std::size_t i = 0; i < y.m.prescribed.size(); ++i)
    if (y.m.prescribed[i].axis == 2) separate += y.s.reaction[i];
  EXPECT_NEAR(together, separate, 1e-9 * std::abs(separate));
  EXPECT_TRUE(any_says(x.report.notes, "`corner` and `floor` hold 3 points together along z: `floor`, which "
                                       "comes first, takes their reaction"));
}

// Requirement: so may motions with the same curve; a support whose points are all held already books nothing.
TEST(Supports, MotionsThatAgreeMayShare) {
  auto c = box_case({2, 2, 2}, {0.2, 0.2, 0.2}, 1e-2);
  c.supports = {support_at("face", plane(0, 0), {true, true, true}),
                support_at("edge", box({-1, -1, -1}, {1e-3, 1, 1e-3}), {false, false, true})};
  c.motions = {motion_at("a", plane(0, 0.2), 0, ramp(1e-5, 1e-3)),
               motion_at("b", plane(0, 0.2), 0, ramp(1e-5, 1e-3))};
  auto const report = report_of(c);
  EXPECT_TRUE(any_says(report.notes, "`edge` and `face` hold 3 points together along z: `face`, which comes "
                                     "first, takes their reaction, and that of `edge` is zero"));
  EXPECT_TRUE(any_says(report.notes, "`b` and `a` hold 9 points together along x"));
}

// Requirement: those that do not agree are refused with both names and the place.
TEST(Supports, ThatDisagreeAreRefused) {
  auto c = box_case({2, 1, 1}, {0.2, 0.1, 0.1}, 1e-2);
  c.supports = {support_at("face", plane(0, 0), {true, false, false})};
  c.motions = {motion_at("pull", plane(0, 0), 0, ramp(1e-5, 1e-3))};
  EXPECT_EQ(refusal_of(c),
            "case.toml:30:1: error: `pull` and `face` both prescribe the x motion of the point at "
            "(0, 0, 0) m, and not alike; let them select different points or components");
}

// ---- bars

// Requirement: bars that lie in each other are named with place and distance; those that touch or cross are
// not.
TEST(BarDoubts, SteelTwice) {
  auto c = tie();
  EXPECT_FALSE(warns(c, "lie in each other"));
  c.bars.push_back(straight_bar({0, 0.05, 0.05}, {0.6, 0.05, 0.05}, 0.012));
  c.bars[1].name = "again";
  EXPECT_TRUE(warns(c, "the bars `bar` and `again` lie in each other at ("));
  EXPECT_TRUE(
      warns(c, "their axes are 0 mm apart, their diameters are 12 and 12 mm, and their steel counts twice"));
  c.bars[1].points = {{0, 0.05, 0.058}, {0.6, 0.05, 0.058}};
  EXPECT_TRUE(warns(c, "their axes are 8 mm apart"));
  c.bars[1].points = {{0, 0.05, 0.062}, {0.6, 0.05, 0.062}}; // they touch
  EXPECT_FALSE(warns(c, "lie in each other"));
  c.bars[1].points = {{0.3, 0.01, 0.05}, {0.3, 0.09, 0.05}}; // a stirrup's leg
  EXPECT_FALSE(warns(c, "lie in each other"));
  c.bars.pop_back();
  c.bars[0].count = 3, c.bars[0].spacing = {0, 0.005, 0};
  EXPECT_TRUE(warns(c, "copies of the bar `bar` lie in each other"));
}

// Requirement: a bar thicker than the body around it is refused, one that fills the section is warned of.
TEST(BarDoubts, MoreSteelThanConcrete) {
  auto c = tie();
  c.bars[0].diameter = 0.5;
  EXPECT_EQ(refusal_of(c),
            "case.toml:25:1: error: the bar `bar` is 500 mm thick and the body around it 100 mm "
            "along y: is the unit of `diameter` right?");
  c.bars[0].diameter = 0.08;
  EXPECT_TRUE(warns(c, "the bars fill 50.3 % of the volume of the body"));
  c.bars[0].diameter = 0.099, c.bars[0].count = 2, c.bars[0].spacing = {0, 0.001, 0};
  EXPECT_TRUE(warns(c, "there is more steel than concrete: the bars fill 154 %"));
}

// ---- materials

// Requirement: properties that contradict each other are warned of with what follows.
TEST(MaterialDoubts, SayTheConsequence) {
  auto const with = [](auto change) {
    auto c = tie();
    change(c);
    return c;
  };
  EXPECT_TRUE(report_of(tie()).warnings.empty() || !warns(tie(), "concrete_1"));
  EXPECT_TRUE(warns(with([](auto& c) { c.concretes[0].penalty = 0.5 * c.concretes[0].E; }),
                    "`penalty` = 0.5 E: the joints are so soft that the sound body has 17 % of its `E`"));
  EXPECT_TRUE(warns(with([](auto& c) { c.concretes[0].penalty = 8000 * c.concretes[0].E; }),
                    "`penalty` = 8e+03 E makes the time step 20 times shorter than 20 E does"));
  EXPECT_TRUE(
      warns(with([](auto& c) { c.concretes[0].cohesion = 30e9; }), "nothing can crush, or crack by shear"));
  EXPECT_TRUE(warns(with([](auto& c) { c.concretes[0].cohesion = 1e5; }), "the body crushes long before"));
  EXPECT_TRUE(warns(with([](auto& c) { c.concretes[0].friction_angle = 1.2; }),
                    "`friction_angle` = 68.8 degrees lies outside the usual"));
  EXPECT_TRUE(warns(with([](auto& c) { c.concretes[0].friction = 5; }), "hold like sound concrete"));
  EXPECT_TRUE(warns(with([](auto& c) { c.concretes[0].nu = 0.49; }), "far too stiff"));
  EXPECT_TRUE(
      warns(with([](auto& c) { c.concretes[0].density_factor = 0.01; }), "`density_factor` = 0.01 makes"));
  EXPECT_TRUE(warns(with([](auto& c) { c.concretes[0].E = 1e9, c.concretes[0].penalty = 20e9; }),
                    "as good as nothing can crack"));
  EXPECT_TRUE(warns(with([](auto& c) { c.concretes[0].f_t = 1e4; }), "it cracks under next to nothing"));
  EXPECT_TRUE(warns(with([](auto& c) { c.concretes[0].G_f = 0.1; }), "runs through at once"));
  EXPECT_TRUE(warns(with([](auto& c) { c.concretes[0].mu_bar = 1e9; }), "carried by viscosity"));
  EXPECT_TRUE(warns(with([](auto& c) { c.steels[0].f_u = 3e9; }), "times `f_y`; 1.05 to 1.5 are usual"));
  EXPECT_TRUE(warns(with([](auto& c) {
                      c.steels[0].eps_sh = 0.004, c.steels[0].eps_u = 0.006, c.steels[0].eps_br = 0.008;
                    }),
                    "is it a strain, not per cent?"));
  EXPECT_TRUE(
      warns(with([](auto& c) { c.run.residual_stop = 2; }), "nothing stops a run that creates or loses"));
  EXPECT_TRUE(warns(with([](auto& c) { c.run.local_damping = 0.95; }), "it creeps"));
}

// Requirement: joints whose strength a region multiplies out of sight are warned of.
TEST(MaterialDoubts, RegionsThatCannotCrack) {
  auto c = tie();
  model::JointRegionSpec r;
  r.place = {"case.toml", 15, 1}, r.strength_factor = 1e5;
  c.joint_regions = {r};
  EXPECT_TRUE(warns(c, "case.toml:15:1: `strength_factor` = 1e+05: these joints cannot crack"));
  c.joint_regions[0].strength_factor = 1e-6; // a notch
  EXPECT_FALSE(warns(c, "`strength_factor`"));
}

// ---- bodies

// Requirement: every body that nothing holds is named, also where another one is held; one that touches a
// held one, and one that a bar ties to it, are not.
TEST(Held, EveryBody) {
  auto c = tie();
  auto lying = box_of_cells("free", {1, 0, 0}, {1.4, 0.1, 0.1}, {4, 1, 1});
  lying.body = "free";
  c.mesh.boxes.push_back(lying);
  EXPECT_TRUE(warns(c, "nothing holds the body of group `free` around (1.2, 0.05, 0.05) m"));
  c.mesh.boxes[1] = box_of_cells("free", {0.1, 0, 0.1}, {0.3, 0.1, 0.2}, {2, 1, 1});
  c.mesh.boxes[1].body = "free";
  EXPECT_FALSE(warns(c, "nothing holds the body"));
  c.contact.on = false;
  EXPECT_TRUE(warns(c, "nothing holds the body of group `free` around (0.2, 0.05, 0.15) m"));
  c.planes = {{}}; // it may fall
  c.planes[0].point = {0, 0, -1}, c.planes[0].normal = {0, 0, 1};
  EXPECT_FALSE(warns(c, "nothing holds the body"));
}

// Requirement: many loose bodies do not fill the log.
TEST(Held, ManyBodies) {
  auto c = tie();
  for (int i = 0; i < 8; ++i) {
    c.mesh.boxes.push_back(box_of_cells("free", {1.0 + i, 0, 0}, {1.4 + i, 0.1, 0.1}, {4, 1, 1}));
    c.mesh.boxes.back().body = "free" + std::to_string(i);
  }
  EXPECT_TRUE(warns(c, "and 3 more bodies that nothing holds"));
}

// ---- bearings

model::Case beam(model::Selector bearing, std::array<bool, 3> fix) {
  auto c = box_case({24, 2, 4}, {1.2, 0.1, 0.2}, 0.1);
  c.supports = {support_at("bearing", std::move(bearing), fix),
                support_at("other", box({1.149, -1, -1}, {1.151, 1, 1e-3}), {false, true, true})};
  c.motions = {motion_at("push", box({0.599, -1, 0.199}, {0.601, 1, 1}), 2, ramp(-1e-4, 0.1))};
  return c;
}

// Requirement: a bearing with a length along the member keeps it from turning there and is warned of; a line
// across it, a clamped end face and a block held over its height are what they are meant to be.
TEST(Bearings, PatchesClamp) {
  auto const said = "holds z over a length of 50 mm along x: that keeps the member from turning there";
  EXPECT_TRUE(warns(beam(box({0.049, -1, -1}, {0.101, 1, 1e-3}), {true, true, true}), said));
  EXPECT_TRUE(warns(beam(box({0.049, -1, -1}, {0.101, 1, 1e-3}), {false, false, true}), said));
  EXPECT_FALSE(warns(beam(box({0.049, -1, -1}, {0.051, 1, 1e-3}), {true, true, true}), "turning there"));
  EXPECT_FALSE(warns(beam(plane(0, 0), {true, true, true}), "turning there"));
  EXPECT_FALSE(warns(beam(box({-1, -1, -1}, {0.101, 1, 1}), {true, true, true}), "turning there"));
  EXPECT_FALSE(warns(beam(plane(2, 0), {false, false, true}), "turning there"));
  EXPECT_FALSE(warns(beam(box({0.049, -1, -1}, {0.101, 1, 1e-3}), {true, true, false}), "turning there"));
}

// ---- loads and steps

// Requirement: a ramp of a few time steps is named, in the check as in the failure that it leads to; a table
// whose rows the steps pass over too.
TEST(CoarseLoads, AreNamed) {
  auto c = tie();
  EXPECT_FALSE(warns(c, "time step"));
  c.motions[0].curve.over = 1e-3;
  c.run.least_dt = 0.5e-3;
  EXPECT_TRUE(warns(c, "motion `pull`: its ramp of 1 ms has 2 time steps of 0.5 ms: it comes as a jump"));
  EXPECT_TRUE(warns(c, "the run has 6 time steps of"));
  Stepper x(c);
  sim::Monitor monitor(x.m);
  auto e = x.read();
  e.work_supports = 0, e.absolute_work = 1e6, e.strain = 1e6; // all of it created
  auto const trouble = monitor.take(e, x.m, x.s);
  ASSERT_TRUE(trouble.has_value());
  EXPECT_NE(trouble->cause.find("motion `pull`: its ramp of 1 ms has 2 time steps of"), std::string::npos)
      << trouble->cause;
  c.motions[0].curve = {};
  c.motions[0].curve.kind = model::Curve::Kind::table;
  c.motions[0].curve.times = {0, 1e-4, 2e-4}, c.motions[0].curve.values = {0, 1e-3, 2e-3};
  EXPECT_TRUE(warns(c, "its rows follow each other after 0.1 ms"));
}

// Requirement: joint inertia is refused where it cannot be right, and warned of where it is not.
TEST(Step, JointInertiaIsForSlowLoading) {
  auto c = tie();
  c.run.joint_inertia = model::JointInertia::on;
  c.motions[0].curve.value = 1;
  EXPECT_TRUE(warns(c, "with joint inertia cracks come late"));
  c.motions[0].curve.value = 1e-3;
  EXPECT_EQ(refusal_of(c), "none");
  EXPECT_FALSE(warns(c, "joint inertia"));
  EXPECT_FALSE(warns(c, "joint_inertia"));
  auto fast = c;
  fast.concretes[0].rate_factor = model::RateFactor::mc2010;
  EXPECT_TRUE(warns(fast, "not for impact, spalling and waves"));
  auto scaled = c;
  scaled.run.least_dt = 1e-6;
  EXPECT_NE(refusal_of(scaled).find("leave `least_dt` out"), std::string::npos);
  auto open = c;
  open.absorbing = {{{"case.toml", 50, 1}, "end", everything()}};
  EXPECT_NE(refusal_of(open).find("case.toml:50:1: error: absorbing boundaries take waves away"),
            std::string::npos)
      << refusal_of(open);
}

// Requirement: a step of which no machine could take enough is refused, with the properties that make it.
TEST(Step, OutOfReach) {
  auto c = tie();
  c.concretes[0].density = 1e-25;
  auto const said = refusal_of(c);
  EXPECT_NE(said.find("`density` = 1e-25 kg/m3"), std::string::npos) << said;
  EXPECT_NE(said.find("and never end"), std::string::npos);
  c = tie();
  c.run.dt = 1e-30;
  EXPECT_NE(refusal_of(c).find("`dt` = "), std::string::npos);
}

// ---- the forecast

// Requirement: the forecast rests on the fastest piece, so that a machine that is busy for most of the look
// does not double it; what it makes of it stands beside.
TEST(Forecast, LeavesOutWhatOthersTake) {
  auto const t = sim::step_time({0.02, 0.011, 0.01, 0.019, 0.04}, 10);
  EXPECT_DOUBLE_EQ(t.undisturbed, 0.001);
  EXPECT_DOUBLE_EQ(t.now, 0.002);
  EXPECT_EQ(sim::step_time({}, 10).now, 0);
}

// Requirement: bars count in the forecast of memory and disk.
TEST(Forecast, CountsBars) {
  auto c = tie();
  Stepper few(c);
  c.bars[0].count = 30, c.bars[0].spacing = {0, 0.0013, 0};
  Stepper many(c);
  auto const a = sim::measure_storage(few.m), b = sim::measure_storage(many.m);
  EXPECT_GT(b.memory, a.memory);
  EXPECT_GT(b.checkpoint, a.checkpoint + 29 * 5 * 400);
  EXPECT_GT(b.disk, a.disk + 29 * 2 * 6 * 60); // two frames, six elements a bar and more
}

// Requirement: no duration is printed that nobody can read.
TEST(Progress, DurationsAreReadable) {
  EXPECT_EQ(sim::readable_duration(12), "12 s");
  EXPECT_EQ(sim::readable_duration(3723), "1 h 02 min");
  EXPECT_EQ(sim::readable_duration(1e300), "3.2e+292 years");
  EXPECT_EQ(sim::readable_duration(std::nan("")), "an unknown time");
  EXPECT_EQ(sim::readable_duration(HUGE_VAL), "an unknown time");
}

} // namespace
} // namespace fissura::support
