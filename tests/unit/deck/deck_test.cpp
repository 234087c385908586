#include "fissura/deck/deck.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <unistd.h>

#include "fissura/deck/scan.hpp"
#include "support/unprivileged.hpp"

namespace {
using namespace fissura;
using deck::read_case_text;

constexpr char const* small = R"(title = "prism"
[[mesh.box]]
from = ["0 m", "0 m", "0 m"]
to = ["1 m", "200 mm", "20 cm"]
cells = [10, 2, 2]
[[concrete]]
E = "29.73 GPa"
f_t = "3.15 MPa"
f_c = "40 MPa"
[[support]]
name = "left"
where = {plane = "x", at = "0 m"}
fix = ["x", "y"]
[run]
end_time = "0.5 s"
)";

// One value of every kind, in an order and spelling a user might choose.
constexpr char const* full = R"(title = "all \"keys\""
[mesh]
[[mesh.box]]
name = "beam"
from = ["0 m", "0 m", "0 m"]
to = ["4.5 m", "150 mm", "250 mm"]
cells = [36, 4, 8]
tets_per_cell = 24
grading = [1, 2.5, 0.1]
[[mesh.box]]
name = "plate"
from = ["4.5 m", "0 m", "0 m"]
to = ["4.6 m", "150 mm", "250 mm"]
cells = [1, 4, 8]

[[concrete]]
name = "C40"
groups = ["beam"]
E = "29.73 GPa"
nu = 0.19
density = "2.4 t/m3"
density_factor = 3
f_t = "3.15 N/mm2"
f_c = "40 MPa"
G_f = "0.142 N/mm"
G_s = "1 kJ/m2"
tet_law = "paper"
mu_bar = "7e6 Pa s"
penalty = 60
h = "31 mm"
joint_law = "paper"
softening_range = "y3d"
friction_angle = "35.5 deg"
cohesion = "10.4 MPa"
friction = 0.7
[[concrete]]
E = "210 GPa"
joints = false
crackable = false
penalty = "600 GPa"
h = "joint_edge"
shear = "constant"
f_s = "5 MPa"

[[joint_region]]
where = {box = [["1 m", "0 m", "0 m"], ["1.1 m", "1 m", "1 m"]]}
strength_factor = 0.4
crackable = false
axis = "y"
[[joint_region]]
where = {all = true}

[[steel]]
name = "S420"
E_s = "210 GPa"
f_y = "420 MPa"
f_u = "500 MPa"
eps_sh = 0.015
law = "menegotto_pinto"

[[bar]]
name = "bottom"
steel = "S420"
diameter = "12 mm"
points = [["20 mm", "30 mm", "35 mm"], ["4.48 m", "30 mm", "35 mm"]]
count = 4
spacing = ["0 mm", "30 mm", "0 mm"]
initial_strain = 1e-4
slip_reduction = "paper"
[[bar]]
steel = "S420"
area = "1.02 cm2"
points = [["1 m", "30 mm", "35 mm"], ["1 m", "120 mm", "35 mm"], ["1 m", "120 mm", "215 mm"]]
closed = true
slip_reduction = "paper"
l_cr = "100 mm"
[bars]
between_cracks = "elastic"
dowel = false

[[stage]]
name = "weight"
duration = "0.1 s"
mass_damping = "274 1/s"
settle = 1e-4
[[stage]]
name = "load"
duration = "2 s"
local_damping = 0.1

[[support]]
name = "left"
where = {line = [["0.25 m", "0 m", "0 m"], ["0.25 m", "0.15 m", "0 m"]], tolerance = "1 mm"}
fix = ["z", "x"]
[[motion]]
name = "press"
stage = "load"
where = {group = "plate"}
axis = "z"
displacement = {cycles = ["1 mm", "-2 mm"], period = "0.1 s", repeats = 2, one_sided = true}
[[motion]]
where = {point = ["4.5 m", "0 m", "0 m"]}
axis = "x"
velocity = {table = [["0 s", "0 m/s"], ["1 s", "0.1 m/s"]]}
[[force]]
where = {point = ["2 m", "0 m", "0.25 m"], tolerance = "10 mm"}
direction = [0, 3, -4]
force = {value = "64.3 kN", over = "0.3 s"}
[[traction]]
name = "lid"
where = {plane = "z", at = "250 mm"}
normal = true
traction = "2 kPa"
[[traction]]
where = {plane = "z", at = "250 mm"}
direction = [1, 1, 1]
traction = {value = "1 Pa"}
[gravity]
stage = "weight"
acceleration = {value = "9.81 m/s2", over = "50 ms"}

[run]
end_time = "1.7 s"
dt_factor = 0.8
dt = "1 us"
mass_damping = "3 Hz"
local_damping = 0.05
threads = 2
max_steps = 5000000000
energy_every = 10
residual_warn = 0.02
residual_stop = 0.2

[[gauge]]
name = "deflection"
kind = "displacement"
where = {point = ["2.25 m", "75 mm", "125 mm"]}
axis = "z"
factor = -1
zero_at = "load"
[[gauge]]
name = "load in all"
kind = "reaction"
of = ["left", "press", "motion_2"]
axis = "z"
[[gauge]]
name = "applied"
kind = "force"
of = ["force_1", "lid"]
[[gauge]]
name = "steel"
kind = "bar"
bar = "bottom"
copy = 3
quantity = "normalised_slip"
at = ["2 m", "0 m", "0 m"]
[[gauge]]
name = "crack"
kind = "crack_width"
line = [["1 m", "0 m", "0 m"], ["3 m", "0 m", "0 m"]]
[[stop]]
gauge = "deflection"
above = "30 mm"
[[stop]]
gauge = "applied"
below = -5
falls_to = 0.8
after = "10 kN"

[[plane]]
name = "floor"
point = ["0 m", "0 m", "-10 mm"]
normal = [0, 0, 1]
friction = 0.3

[[impactor]]
shape = "cylinder"
from = ["1 m", "0 m", "1 m"]
to = ["1 m", "0.5 m", "1 m"]
radius = "80 mm"
mass = "0.3 t"
velocity = ["0 m/s", "0 m/s", "-18 km/h"]
moves = ["z"]

[[impactor]]
name = "ball"
shape = "sphere"
centre = ["2 m", "0 m", "1 m"]
radius = "5 cm"
mass = "4 kg"

[[initial_velocity]]
where = {group = "beam"}
velocity = ["0 m/s", "1 m/s", "0 m/s"]

[[gauge]]
name = "blow"
kind = "contact_impulse"
of = ["floor", "impactor_1"]
axis = "z"

[[gauge]]
name = "fall"
kind = "impactor_displacement"
of = ["ball"]
axis = "z"

[output]
history_points = 200
history_every = "1 ms"
frames = 7
frames_every = "0.1 s"
magnify = 50
)";

// Values arrive in SI, exactly, and what is not said is the default of the case.
TEST(Deck, ReadsQuantitiesIntoSi) {
  auto const c = read_case_text(small, "small.toml");
  EXPECT_EQ(c.title, "prism");
  ASSERT_EQ(c.mesh.boxes.size(), 1U);
  EXPECT_EQ(c.mesh.boxes[0].to, (Vec3{1, 0.2, 0.2}));
  EXPECT_EQ(c.mesh.boxes[0].cells, (std::array<int, 3>{10, 2, 2}));
  ASSERT_EQ(c.concretes.size(), 1U);
  EXPECT_EQ(c.concretes[0].E, 29.73e9);
  EXPECT_EQ(c.concretes[0].f_t, 3.15e6);
  EXPECT_EQ(c.concretes[0].nu, 0.2);
  EXPECT_EQ(c.concretes[0].penalty, 20 * 29.73e9) << "the default penalty is 20 E";
  EXPECT_EQ(c.run.joint_inertia, model::JointInertia::automatic);
  EXPECT_EQ(c.concretes[0].name, "concrete_1");
  EXPECT_EQ(c.supports[0].fix, (std::array<bool, 3>{true, true, false}));
  EXPECT_EQ(c.supports[0].where.kind, model::Selector::Kind::plane);
  EXPECT_EQ(c.run.end_time, 0.5);
  EXPECT_FALSE(c.gravity.on);
}

// Every key reaches its own field.
TEST(Deck, ReadsEveryKey) {
  auto const c = read_case_text(full, "full.toml");
  EXPECT_EQ(c.title, "all \"keys\"");
  EXPECT_EQ(c.mesh.boxes[0].tets_per_cell, 24);
  EXPECT_EQ(c.mesh.boxes[0].grading, (std::array<double, 3>{1, 2.5, 0.1}));
  auto const& m = c.concretes[0];
  EXPECT_EQ(m.groups, std::vector<std::string>{"beam"});
  EXPECT_EQ(m.density, 2400);
  EXPECT_EQ(m.density_factor, 3);
  EXPECT_EQ(m.G_f, 142);
  EXPECT_EQ(m.G_s, 1000);
  EXPECT_EQ(m.mu_bar, 7e6);
  EXPECT_EQ(m.penalty, 60 * 29.73e9);
  EXPECT_EQ(m.element_size, model::ElementSize::given);
  EXPECT_EQ(m.h, 0.031);
  EXPECT_EQ(m.tet_law, model::TetLaw::paper);
  EXPECT_EQ(m.joint_law, model::JointLaw::paper);
  EXPECT_EQ(m.softening_range, model::SofteningRange::y3d);
  EXPECT_NEAR(m.friction_angle, 35.5 * std::numbers::pi / 180, 1e-15);
  EXPECT_EQ(c.concretes[1].penalty, 600e9);
  EXPECT_EQ(c.concretes[1].element_size, model::ElementSize::joint_edge);
  EXPECT_EQ(c.concretes[1].shear, model::ShearStrength::constant);
  EXPECT_EQ(c.concretes[1].f_s, 5e6);
  EXPECT_TRUE(c.joint_regions[0].only_axis);
  EXPECT_EQ(c.joint_regions[0].axis, 1);
  EXPECT_FALSE(c.joint_regions[1].only_axis);
  EXPECT_EQ(c.steels[0].law, model::SteelLaw::menegotto_pinto);
  EXPECT_EQ(c.bars[0].count, 4);
  EXPECT_EQ(c.bars[0].spacing, (Vec3{0, 0.03, 0}));
  EXPECT_NEAR(c.bars[1].diameter, std::sqrt(4 * 1.02e-4 / std::numbers::pi), 1e-17);
  EXPECT_EQ(c.bars[1].area, 1.02e-4);
  EXPECT_EQ(c.bars[1].l_cr_from, model::CrackLength::given);
  EXPECT_EQ(c.bar_settings.between_cracks, model::BarBetweenCracks::elastic);
  EXPECT_FALSE(c.bar_settings.dowel);
  EXPECT_EQ(c.stages[0].mass_damping, 274);
  EXPECT_EQ(c.stages[1].mass_damping, -1);
  EXPECT_EQ(c.supports[0].where.tolerance, 1e-3);
  EXPECT_EQ(c.motions[0].curve.peaks, (std::vector<double>{1e-3, -2e-3}));
  EXPECT_TRUE(c.motions[0].curve.one_sided);
  EXPECT_FALSE(c.motions[0].is_velocity);
  EXPECT_TRUE(c.motions[1].is_velocity);
  EXPECT_EQ(c.motions[1].curve.values, (std::vector<double>{0, 0.1}));
  EXPECT_EQ(c.forces[0].direction, (Vec3{0, 0.6, -0.8}));
  EXPECT_EQ(c.forces[0].curve.kind, model::Curve::Kind::ramp);
  EXPECT_EQ(c.forces[0].curve.value, 64.3e3);
  EXPECT_TRUE(c.tractions[0].normal);
  EXPECT_EQ(c.tractions[0].curve.kind, model::Curve::Kind::constant);
  EXPECT_EQ(c.tractions[0].curve.value, 2000);
  EXPECT_TRUE(c.gravity.on);
  EXPECT_EQ(c.gravity.stage, "weight");
  EXPECT_EQ(c.run.dt, 1e-6);
  EXPECT_EQ(c.run.max_steps, 5000000000L);
  EXPECT_EQ(c.gauges[0].zero_at, "load");
  EXPECT_EQ(c.gauges[3].quantity, "normalised_slip");
  EXPECT_EQ(c.gauges[3].from, (Vec3{2, 0, 0}));
  EXPECT_EQ(c.gauges[4].to, (Vec3{3, 0, 0}));
  EXPECT_EQ(c.stops[0].above, 0.03);
  EXPECT_TRUE(c.stops[0].has_above);
  EXPECT_FALSE(c.stops[0].has_below);
  EXPECT_EQ(c.stops[1].below, -5);
  EXPECT_EQ(c.stops[1].after, 10e3);
  EXPECT_EQ(c.planes[0].point, (Vec3{0, 0, -0.01}));
  EXPECT_EQ(c.planes[0].normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(c.planes[0].friction, 0.3);
  EXPECT_EQ(c.impactors[0].name, "impactor_1");
  EXPECT_EQ(c.impactors[0].shape, model::ImpactorSpec::Shape::cylinder);
  EXPECT_EQ(c.impactors[0].to, (Vec3{1, 0.5, 1}));
  EXPECT_EQ(c.impactors[0].mass, 300);
  EXPECT_EQ(c.impactors[0].velocity, (Vec3{0, 0, -5}));
  EXPECT_EQ(c.impactors[0].moves, (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(c.impactors[1].radius, 0.05);
  EXPECT_EQ(c.impactors[1].friction, 0.6);
  EXPECT_EQ(c.initial_velocities[0].velocity, (Vec3{0, 1, 0}));
  EXPECT_EQ(c.gauges.back().kind, model::GaugeSpec::Kind::impactor_displacement);
  EXPECT_EQ(c.output.frames, 7);
}

// The echo reads back to the same case: a second echo is the same text, value by value.
TEST(Deck, EchoRoundTrips) {
  for (auto const* text : {small, full}) {
    auto const first = read_case_text(text, "case.toml");
    std::string const echoed = deck::echo(first);
    auto const second = read_case_text(echoed, "echo.toml");
    EXPECT_EQ(deck::echo(second), echoed);
    ASSERT_EQ(first.concretes.size(), second.concretes.size());
    for (std::size_t i = 0; i < first.concretes.size(); ++i) {
      EXPECT_EQ(first.concretes[i].penalty, second.concretes[i].penalty);
      EXPECT_EQ(first.concretes[i].friction_angle, second.concretes[i].friction_angle);
      EXPECT_EQ(first.concretes[i].density, second.concretes[i].density);
    }
    for (std::size_t i = 0; i < first.bars.size(); ++i) {
      EXPECT_EQ(first.bars[i].diameter, second.bars[i].diameter);
      EXPECT_EQ(first.bars[i].area, second.bars[i].area);
      EXPECT_EQ(first.bars[i].points, second.bars[i].points);
    }
    for (std::size_t i = 0; i < first.tractions.size(); ++i)
      EXPECT_EQ(first.tractions[i].direction, second.tractions[i].direction);
    EXPECT_EQ(first.title, second.title);
    EXPECT_EQ(first.stages.size(), second.stages.size());
    EXPECT_EQ(first.run.max_steps, second.run.max_steps);
  }
}

// Targets of a path are read in the unit of their gauge, whose section may come later; the echo keeps them.
TEST(Deck, ReadsPaths) {
  std::string const text = std::string(small) + R"(
[[motion]]
name = "right"
where = {plane = "x", at = "1 m"}
axis = "x"
path = {speed = "0.1 m/s", turn = "5 ms", then = "rest", to = [{gauge = "strain", value = 0.002}, {gauge = "force", value = "3 kN"}]}
[[motion]]
where = {plane = "x", at = "0 m"}
axis = "x"
path = {of = "right", scale = -1}
[[gauge]]
name = "strain"
kind = "mean_strain"
line = [["0 m", "0 m", "0 m"], ["1 m", "0 m", "0 m"]]
[[gauge]]
name = "force"
kind = "reaction"
of = ["right"]
axis = "x"
)";
  auto const first = read_case_text(text, "case.toml");
  std::string const echoed = deck::echo(first);
  auto const second = read_case_text(echoed, "echo.toml");
  EXPECT_EQ(deck::echo(second), echoed);
  for (auto const& c : {first, second}) {
    ASSERT_EQ(c.motions.size(), 2U);
    ASSERT_TRUE(c.motions[0].path && c.motions[1].path);
    auto const& path = *c.motions[0].path;
    EXPECT_EQ(path.speed, 0.1);
    EXPECT_EQ(path.turn, 5e-3);
    EXPECT_FALSE(path.stops);
    ASSERT_EQ(path.targets.size(), 2U);
    EXPECT_EQ(path.targets[0].value, 0.002);
    EXPECT_EQ(path.targets[1].gauge, "force");
    EXPECT_EQ(path.targets[1].value, 3000);
    EXPECT_EQ(c.motions[1].path->of, "right");
    EXPECT_EQ(c.motions[1].path->scale, -1);
  }
}

// A record of accelerations is found beside the deck, `g` is gravity there, and the echo keeps all of it.
TEST(Deck, ReadsRecords) {
  auto const folder = std::filesystem::temp_directory_path() / ("fissura_deck_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "quake.txt") << "0 0\n1 1\n";
  std::string const text = std::string(small) + R"(
[[motion]]
where = {plane = "x", at = "1 m"}
axis = "x"
acceleration = {file = "quake.txt", unit = "g", pga = "0.3 g", baseline = "linear", start = "0.5 s", columns = [3, 2]}
[[motion]]
where = {plane = "x", at = "1 m"}
axis = "y"
acceleration = {file = "quake.txt", unit = "cm/s2", time_step = "10 ms"}
)";
  auto const first = read_case_text(text, (folder / "case.toml").string());
  std::string const echoed = deck::echo(first);
  auto const second = read_case_text(echoed, "/echo.toml");
  EXPECT_EQ(deck::echo(second), echoed);
  std::filesystem::remove_all(folder);
  for (auto const& c : {first, second}) {
    ASSERT_TRUE(c.motions[0].record && c.motions[1].record);
    auto const &a = *c.motions[0].record, &b = *c.motions[1].record;
    EXPECT_EQ(a.file, (folder / "quake.txt").string());
    EXPECT_EQ(a.unit, 9.80665);
    EXPECT_EQ(a.pga, 0.3 * 9.80665);
    EXPECT_EQ(a.baseline, model::RecordSpec::Baseline::linear);
    EXPECT_EQ(a.start, 0.5);
    EXPECT_EQ(a.time_column, 3);
    EXPECT_EQ(a.acceleration_column, 2);
    EXPECT_EQ(b.unit, 0.01);
    EXPECT_EQ(b.time_step, 0.01);
    EXPECT_EQ(b.time_column, 0);
    EXPECT_EQ(b.acceleration_column, 0);
  }
}

/// A deck whose motions, force, traction and gravity hold these curves; the files lie beside it.
std::string with_curves(std::string const& displacement, std::string const& velocity,
                        std::string const& force, std::string const& traction, std::string const& gravity) {
  std::string const x1 = "where = {plane = \"x\", at = \"1 m\"}\n";
  return std::string(small) + "[[motion]]\n" + x1 + "axis = \"x\"\ndisplacement = " + displacement +
         "\n[[motion]]\n" + x1 + "axis = \"y\"\nvelocity = " + velocity + "\n[[force]]\n" + x1 +
         "direction = [0, 0, 1]\nforce = " + force + "\n[[traction]]\n" + x1 +
         "normal = true\ntraction = " + traction + "\n[gravity]\nacceleration = " + gravity + "\n";
}

// A history in a file is the table of its rows to the last bit, with times or at a constant step, whatever
// the curve is of; the echo holds the rows and needs the file no more; what was read stands in the notes.
TEST(Deck, ReadsCurvesFromFiles) {
  auto const folder =
      std::filesystem::temp_directory_path() / ("fissura_curve_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "timed.txt") << "time value\n0 0\n0.07 0.1D0\n0.3 -0.7\n";
  std::ofstream(folder / "spaced.txt") << "NPTS= 4, DT= .07 SEC\n0 0.1 -0.7\n0.3\n";
  std::string const timed = "{file = \"timed.txt\", unit = \"", spaced = "{file = \"spaced.txt\", unit = \"";
  auto const files = read_case_text(with_curves(timed + "mm\"}", spaced + "mm/s\", time_step = \"70 ms\"}",
                                                spaced + "kN\"}", timed + "MPa\", columns = [1, 2]}",
                                                spaced + "g\", columns = [1], time_step = \"0.5 s\"}"),
                                    (folder / "case.toml").string());
  auto const rows = [](std::string const& unit, bool is_timed) {
    auto const row = [&](char const* t, char const* v) {
      return "[\"" + std::string(t) + " s\", \"" + v + " " + unit + "\"]";
    };
    return is_timed
               ? "{table = [" + row("0", "0") + ", " + row("0.07", "0.1") + ", " + row("0.3", "-0.7") + "]}"
               : "{table = [" + row("0", "0") + ", " + row("0.07", "0.1") + ", " + row("0.14", "-0.7") +
                     ", " + row("0.21", "0.3") + "]}";
  };
  auto const tables =
      read_case_text(with_curves(rows("mm", true), rows("mm/s", false), rows("kN", false), rows("MPa", true),
                                 "{table = [[\"0 s\", \"0 g\"], [\"0.5 s\", \"0.3 g\"]]}"),
                     "case.toml");
  std::filesystem::remove_all(folder);
  auto const echoed = deck::echo(files);
  EXPECT_EQ(echoed, deck::echo(tables));
  EXPECT_EQ(deck::echo(read_case_text(echoed, "/echo.toml")), echoed);
  EXPECT_EQ(files.motions[0].curve.times, tables.motions[0].curve.times);
  EXPECT_EQ(files.motions[0].curve.values, tables.motions[0].curve.values);
  EXPECT_EQ(files.motions[1].curve.times, tables.motions[1].curve.times);
  EXPECT_EQ(files.forces[0].curve.values, (std::vector<double>{0, 100, -700, 300}));
  EXPECT_EQ(files.tractions[0].curve.values, (std::vector<double>{0, 0.1e6, -0.7e6}));
  EXPECT_EQ(files.gravity.curve.values, tables.gravity.curve.values);
  auto const has = [](std::vector<std::string> const& lines, std::string const& text) {
    return std::any_of(lines.begin(), lines.end(), [&](auto const& l) { return l.find(text) != l.npos; });
  };
  EXPECT_TRUE(has(files.notes,
                  "`displacement` from \"timed.txt\": 3 values at steps of 0.07 to 0.23 s, 0.3 s, "
                  "-0.7 mm to 0.1 mm"));
  EXPECT_TRUE(has(files.notes, "`force` from \"spaced.txt\": 4 values at a step of 0.07 s, 0.21 s"));
  EXPECT_TRUE(has(files.warnings, "the header names a step of 0.07 s, but `time_step` of the deck is 0.5 s"));
}

// What is wrong in a curve's file is reported with its place in the file, beside the errors of the deck.
TEST(Deck, FaultyCurveFiles) {
  auto const folder =
      std::filesystem::temp_directory_path() / ("fissura_curves_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "words.txt") << "0 0\n1 one\n";
  std::ofstream(folder / "early.txt") << "-1 0\n1 1\n";
  std::ofstream(folder / "long.txt") << [] {
    std::string text;
    for (int i = 0; i <= 200000; ++i) text += "0\n";
    return text;
  }();
  auto const said = [&](std::string const& curve) {
    try {
      read_case_text(with_curves(curve, "\"0 m/s\"", "\"0 N\"", "\"0 Pa\"", "\"0 g\""),
                     (folder / "case.toml").string());
    } catch (core::InputError const& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  auto const has = [](std::string const& text, std::string const& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(said("{file = \"words.txt\", unit = \"mm\"}"), "words.txt:2:3: error: `one` is not a finite number");
  has(said("{file = \"early.txt\", unit = \"mm\"}"), "the times of \"early.txt\" begin at -1 s");
  has(said("{file = \"long.txt\", unit = \"mm\", time_step = \"1 ms\"}"),
      "\"long.txt\" has 200001 values; at most 200000 are allowed: thin it out");
  std::filesystem::remove_all(folder);
}

// The echo names every default that the deck left unsaid.
TEST(Deck, EchoHoldsTheDefaults) {
  std::string const text = deck::echo(read_case_text(small, "case.toml"));
  for (auto const* line : {"nu = 0.2\n", "density = \"2500 kg/m3\"\n", "joint_inertia = \"automatic\"\n",
                           "penalty = \"594.6 GPa\"\n", "friction_angle = \"36 deg\"\n",
                           "joint_law = \"energy_consistent\"\n", "dt_factor = 0.85\n", "dowel = true\n",
                           "history_points = 1000\n", "tets_per_cell = 6\n", "h = \"volume\"\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
}

// An override changes one value before the checks, whether it is TOML, a bare word or a quantity without
// quotes.
TEST(Deck, Overrides) {
  auto const c =
      read_case_text(small, "s.toml",
                     {"concrete.0.penalty=60", "concrete.0.h=joint_edge", "concrete.0.f_t=2 MPa",
                      "run.end_time=\"2 s\"", "output.frames=3", "support.0.where={plane=\"y\", at=\"1 m\"}",
                      "mesh.box.0.cells=[4, 5, 6]", "concrete.0.crackable=false"});
  EXPECT_EQ(c.concretes[0].penalty, 60 * 29.73e9);
  EXPECT_EQ(c.concretes[0].element_size, model::ElementSize::joint_edge);
  EXPECT_EQ(c.concretes[0].f_t, 2e6);
  EXPECT_FALSE(c.concretes[0].crackable);
  EXPECT_EQ(c.run.end_time, 2);
  EXPECT_EQ(c.output.frames, 3);
  EXPECT_EQ(c.supports[0].where.axis, 1);
  EXPECT_EQ(c.mesh.boxes[0].cells[2], 6);
}

// Texts may hold any character and quotes of the other kind, on one line or on several.
TEST(Deck, TextsOfAllKinds) {
  std::string const rest = std::string(small).substr(std::string(small).find('\n'));
  for (auto const* title :
       {R"("Träger \"1\" 'a'")", R"('Träger "1"')", R"("""Träger ""1"""")", "'''Trä\nger''''"}) {
    auto const c = read_case_text(std::string("'title' = ") + title + " # ä" + rest, "s.toml");
    EXPECT_NE(c.title.find("Trä"), std::string::npos) << title;
  }
}

std::string refusal(std::vector<std::string> const& overrides) {
  try {
    read_case_text(small, "s.toml", overrides);
  } catch (core::InputError const& e) {
    return e.what();
  }
  return "accepted";
}

// A faulty override is quoted as it was written, and does not hide other errors.
TEST(Deck, FaultyOverrides) {
  EXPECT_EQ(refusal({"concrete.1.penalty=60"}),
            "--set concrete.1.penalty=60: error: `concrete` has 1 items, numbered from 0; there is no 1");
  EXPECT_EQ(refusal({"concrete.penalty=60"}), "--set concrete.penalty=60: error: `concrete` is an array: "
                                              "name the item by its number, e.g. concrete.0.penalty");
  EXPECT_EQ(refusal({"title"}), "--set title: error: expected key.path=value, e.g. run.end_time=\"1 s\"");
  EXPECT_EQ(refusal({"run..x=1"}),
            "--set run..x=1: error: a part of the path is empty; expected key.path=value");
  EXPECT_EQ(refusal({"run.end_tme=1 s"}),
            "--set run.end_tme=1 s: error: unknown key `end_tme` in [run]; did you mean `end_time`?");
  std::string const two = refusal({"run.end_time=5", "concrete.0.nu=0.5"});
  EXPECT_NE(two.find("`end_time` needs a unit"), std::string::npos) << two;
  EXPECT_NE(two.find("`nu` must be -1 < x < 0.5, not 0.5"), std::string::npos) << two;
  auto const says = [](std::string const& override_text, std::string const& reason) {
    EXPECT_NE(refusal({override_text}).find(reason), std::string::npos) << refusal({override_text});
  };
  says("run.end_time=1 s\nthreads=3", "give one value on one line");
  says("run.end_time=\"1 s\"\nthreads=3", "give one value on one line");
  says("title.size=3", "`title` is a text, it has no `size`");
  says("a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q=1", "more than 16 parts in a dotted key");
  says("\"a.b.c.d.e.f.g.h.i.j.k.l.m.n.o.p.q\"=1", "the path is too deep");
}

/// That it is an error of the input, in these words.
template <class Action> void expect_refused(Action const& action, std::string const& words) {
  try {
    action();
    FAIL() << "accepted";
  } catch (core::InputError const& e) {
    EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
  }
}

class DeckFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() / ("fissura_deck_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder / "case");
    write("case/beam.msh", "");
    write("other.msh", "");
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  void write(std::string const& name, std::string const& text) { std::ofstream(folder / name) << text; }
  model::Case read(std::string const& mesh) {
    write("case/case.toml",
          "[mesh]\n" + mesh + "\n[[concrete]]\nE = \"30 GPa\"\njoints = false\n[run]\nend_time = \"1 s\"\n");
    return deck::read_case(folder / "case/case.toml");
  }
  std::string refusal(std::string const& mesh) {
    try {
      read(mesh);
    } catch (core::InputError const& e) {
      return e.what();
    }
    return "accepted";
  }
  std::filesystem::path folder;
};

// A mesh file is looked for beside the deck, and the echo finds it from any folder.
TEST_F(DeckFiles, MeshFile) {
  auto const c = read("file = \"beam.msh\"\nlength_unit = \"mm\"");
  EXPECT_EQ(c.mesh.file, std::filesystem::canonical(folder / "case/beam.msh").string());
  EXPECT_EQ(c.mesh.length_unit, 1e-3);
  auto const again = read_case_text(deck::echo(c), "/elsewhere/case.toml");
  EXPECT_EQ(again.mesh.file, c.mesh.file);
  EXPECT_EQ(again.mesh.length_unit, 1e-3);
}

// A mesh file outside the deck's folder is refused unless the deck allows it; a missing one is named.
TEST_F(DeckFiles, MeshFileOutsideOrMissing) {
  EXPECT_NE(refusal("file = \"../other.msh\"\nlength_unit = \"m\"").find("lies outside the deck's folder"),
            std::string::npos);
  std::string const absolute = "file = \"" + (folder / "other.msh").string() + "\"\nlength_unit = \"m\"";
  EXPECT_NE(refusal(absolute).find("lies outside the deck's folder"), std::string::npos);
  EXPECT_EQ(refusal(absolute + "\nallow_outside = true"), "accepted");
  std::filesystem::create_symlink(folder / "other.msh", folder / "case/link.msh");
  EXPECT_NE(refusal("file = \"link.msh\"\nlength_unit = \"m\"").find("lies outside the deck's folder"),
            std::string::npos);
  EXPECT_NE(refusal("file = \"none.msh\"\nlength_unit = \"m\"").find("there is no mesh file \"none.msh\""),
            std::string::npos);
  EXPECT_NE(refusal("file = \"case.toml\"\nlength_unit = \"m\"").find("must end in .msh, .geo or .inp"),
            std::string::npos);
  EXPECT_NE(refusal("file = \"beam.msh\"").find("needs `length_unit`"), std::string::npos);
}

// A missing deck is an input error that names it.
TEST_F(DeckFiles, MissingDeck) {
  try {
    deck::read_case(folder / "nothing.toml");
    FAIL() << "accepted";
  } catch (core::Error const& e) {
    EXPECT_EQ(e.failure, core::Failure::input);
    EXPECT_NE(std::string(e.what()).find("nothing.toml"), std::string::npos);
  }
}

// A deck that may not be read is an input/output failure that names it.
TEST_F(DeckFiles, UnreadableDeck) {
  write("secret.toml", "title = \"secret\"\n");
  std::filesystem::permissions(folder, std::filesystem::perms(0755));
  std::filesystem::permissions(folder / "secret.toml", std::filesystem::perms(0));
  support::Unprivileged const nobody;
  if (!nobody.is()) GTEST_SKIP() << "root stays root here";
  try {
    deck::read_case(folder / "secret.toml");
    FAIL() << "accepted";
  } catch (core::Error const& e) {
    EXPECT_EQ(e.failure, core::Failure::io);
    EXPECT_EQ(e.what(), "cannot read the deck \"" + (folder / "secret.toml").string() + "\"");
  }
}

// A deck larger than any that somebody wrote is refused before it is read.
TEST_F(DeckFiles, LargeDeck) {
  write("large.toml", "title = \"large\"\n");
  std::filesystem::resize_file(folder / "large.toml", (16U << 20U) + 1);
  expect_refused([&] { deck::read_case(folder / "large.toml"); },
                 "large.toml: error: the deck is larger than 16 MiB");
}

// A deck with more values than anybody writes is refused before there is room for them.
TEST(Deck, TooManyValues) {
  std::string text = std::string(small) + "\n[x]\na = [1";
  for (int i = 0; i < 70000; ++i) text += ",1";
  expect_refused([&] { read_case_text(text + "]\n", "s.toml"); },
                 "more than 65536 values; long tables belong in a record file");
}

// A key may be quoted, but holds no control characters and is no book.
TEST(Deck, UnreadableKeys) {
  for (std::string const& key : std::vector<std::string>{"\"a\\u0007b\"", std::string(300, 'k')}) {
    expect_refused([&] { read_case_text(std::string(small) + "\n[run2]\n" + key + " = 1\n", "s.toml"); },
                   "this key holds control characters or is too long");
  }
}

// A load given while a run is on its way is read as in a deck: a constant, a ramp; other keys are refused
// with those there are.
TEST(Deck, LoadCurves) {
  EXPECT_EQ(deck::read_load_curve("\"2 kN\"", "force").value, 2e3);
  auto const ramp = deck::read_load_curve("{value = \"3 mm\", over = \"0.5 s\"}", "displacement");
  EXPECT_DOUBLE_EQ(ramp.value, 3e-3);
  EXPECT_DOUBLE_EQ(ramp.over, 0.5);
  auto const reason = [](char const* value, char const* key) -> std::string {
    try {
      deck::read_load_curve(value, key);
    } catch (core::Error const& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_NE(reason("1", "weight").find("a load has no `weight`: give displacement, velocity, force"),
            std::string::npos);
  EXPECT_NE(reason("\"1 mm\"", "force").find("mm is not a force"), std::string::npos)
      << reason("\"1 mm\"", "force");
}

// docs/reference/deck.md is what the schema says today.
TEST(DeckReference, IsCurrent) {
  std::string const file = FISSURA_EXAMPLES "/../docs/reference/deck.md";
  std::string const wanted = deck::reference_markdown();
  if (std::getenv("FISSURA_UPDATE_REFERENCE")) std::ofstream(file) << wanted;
  std::ifstream in(file);
  std::string const found((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_TRUE(found == wanted)
      << "docs/reference/deck.md is not current: run tools/check_deck_reference.sh --update BUILD";
}

// The deck shown in the reference page reads without an error.
TEST(DeckReference, ItsExampleReads) {
  std::string const page = deck::reference_markdown();
  auto const start = page.find("```toml\n") + 8;
  auto const c = read_case_text(page.substr(start, page.find("```", start) - start), "example.toml");
  EXPECT_EQ(c.gauges.size(), 1U);
  EXPECT_EQ(c.motions[0].curve.over, 0.05);
}

} // namespace
