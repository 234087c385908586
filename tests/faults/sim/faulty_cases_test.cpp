// Cases that a deck may well state but no program can compute: each ends in an InputError that names the
// place in the deck and what is wrong, and leaves no run folder behind.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <ostream>

#include "fissura/sim/run.hpp"
#include "support/cases.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::support {
namespace {

struct Fault {
  char const* name;
  std::function<void(model::Case&)> plant;
  int line;                       ///< of the deck, as the error must name it
  std::vector<std::string> words; ///< in the message
};

/// How the test framework names a fault.
void PrintTo(Fault const& fault, std::ostream* out) {
  *out << fault.name;
}

core::Place line(int number) {
  return {"case.toml", number, 1};
}

model::Selector placed(model::Selector s, int number) {
  s.place = line(number);
  return s;
}

std::vector<Fault> const faults{
    {"bar_outside",
     [](model::Case& c) {
       c.bars[0].points = {{0, 0.05, 0.05}, {0.7, 0.05, 0.05}};
     },
     25,
     {"bar", "concrete"}},
    {"bar_far_away",
     [](model::Case& c) {
       c.bars[0].points = {{5, 5, 5}, {6, 5, 5}};
     },
     25,
     {"bar"}},
    {"bar_copy_outside",
     [](model::Case& c) {
       c.bars[0].count = 3, c.bars[0].spacing = {0, 0.03, 0};
     },
     25,
     {"bar"}},
    {"bar_of_no_length",
     [](model::Case& c) {
       c.bars[0].points = {{0.1, 0.05, 0.05}, {0.1, 0.05, 0.05}};
     },
     25,
     {"bar"}},
    {"bar_of_unknown_steel", [](model::Case& c) { c.bars[0].steel = "B500"; }, 25, {"B500"}},
    {"support_on_nothing",
     [](model::Case& c) { c.supports[0].where = placed(plane(0, 7), 21); },
     21,
     {"point"}},
    {"motion_on_nothing",
     [](model::Case& c) {
       c.motions[0].where = placed(box({2, 2, 2}, {3, 3, 3}), 31);
     },
     31,
     {"point"}},
    {"support_at_unknown_group",
     [](model::Case& c) { c.supports[0].where = placed(group("lefft"), 21); },
     21,
     {"lefft", "concrete"}},
    {"force_on_nothing",
     [](model::Case& c) {
       model::ForceSpec f;
       f.name = "push", f.where = placed(plane(2, 9), 33), f.direction = {1, 0, 0};
       c.forces = {f};
     },
     33,
     {"point"}},
    {"traction_inside",
     [](model::Case& c) {
       model::TractionSpec t;
       t.name = "pressure", t.where = placed(plane(0, 0.3), 34), t.normal = true;
       c.tractions = {t};
     },
     34,
     {"face"}},
    {"two_motions_on_one_node",
     [](model::Case& c) {
       c.motions.push_back(motion_at("again", plane(0, 0.6), 0, constant(0)));
       c.motions.back().place = line(32);
     },
     32,
     {"again", "pull", "x"}},
    {"motion_of_a_support",
     [](model::Case& c) {
       c.motions[0] = motion_at("pull", plane(0, 0), 1, ramp(1e-4, 1e-3)), c.motions[0].place = line(30);
     },
     30,
     {"left", "pull", "y"}},
    {"motion_in_unknown_stage", [](model::Case& c) { c.motions[0].stage = "later"; }, 30, {"later"}},
    {"gauge_of_unknown_support",
     [](model::Case& c) {
       auto g = gauge("force", model::GaugeSpec::Kind::reaction);
       g.of = {"right"};
       c.gauges = {g};
     },
     40,
     {"right"}},
    {"stop_without_gauge",
     [](model::Case& c) {
       model::StopSpec s;
       s.place = line(45), s.gauge = "force";
       c.stops = {s};
     },
     45,
     {"force"}},
    {"concrete_for_unknown_group",
     [](model::Case& c) { c.concretes[0].groups = {"slab"}, c.concretes[0].place = line(10); },
     10,
     {"slab", "concrete"}},
    {"group_of_two_concretes",
     [](model::Case& c) {
       c.concretes[0].groups = {"concrete"};
       c.concretes.push_back(c.concretes[0]), c.concretes[1].place = line(12), c.concretes[1].name = "other";
     },
     12,
     {"volume group `concrete` already belongs to [[concrete]] `"}},
    {"group_without_concrete",
     [](model::Case& c) {
       c.mesh.boxes.push_back(box_of_cells("slab", {0.6, 0, 0}, {0.9, 0.1, 0.1}, {2, 2, 2}));
       c.concretes[0].groups = {"concrete"};
     },
     2,
     {"slab"}},
    {"two_concretes_for_all",
     [](model::Case& c) {
       c.concretes.push_back(c.concretes[0]), c.concretes[1].place = line(12), c.concretes[1].name = "other";
     },
     12,
     {"other", "concrete"}},
    {"touching_boxes_with_different_cells",
     [](model::Case& c) {
       c.mesh.boxes.push_back(box_of_cells("more", {0.6, 0, 0}, {0.9, 0.1, 0.1}, {3, 3, 3}));
     },
     2,
     {"match"}},
    {"overlapping_boxes",
     [](model::Case& c) {
       c.mesh.boxes.push_back(box_of_cells("more", {0.5, 0, 0}, {0.9, 0.1, 0.1}, {3, 2, 2}));
       c.mesh.boxes.back().place = line(7);
     },
     7,
     {"overlap"}},
    {"box_without_volume", [](model::Case& c) { c.mesh.boxes[0].to.y = 0; }, 3, {}},
    {"missing_mesh_file",
     [](model::Case& c) { c.mesh.boxes.clear(), c.mesh.file = "/nowhere/beam.msh"; },
     0,
     {"beam.msh"}},
    {"plane_in_the_body",
     [](model::Case& c) {
       c.planes = {{line(50), "floor", {0, 0, 0.02}, {0, 0, 1}, 0.6}};
     },
     50,
     {"plane `floor` overlaps", "tet", "0.02 m deep", "(0, 0, 0)"}},
    {"impactor_inside_a_tet",
     [](model::Case& c) {
       model::ImpactorSpec i;
       i.place = line(51), i.name = "pellet", i.centre = {0.29, 0.04, 0.03}, i.radius = 1e-3, i.mass = 1;
       c.impactors = {i};
     },
     51,
     {"impactor `pellet` overlaps", "0.001 m deep"}},
    {"gauge_of_no_impactor",
     [](model::Case& c) {
       auto g = gauge("v", model::GaugeSpec::Kind::impactor_velocity);
       g.of = {"ball"};
       c.gauges = {g};
     },
     40,
     {"ball"}},
    {"initial_velocity_of_nothing",
     [](model::Case& c) {
       c.initial_velocities = {{line(52), placed(box({5, 5, 5}, {6, 6, 6}), 53), {0, 0, 1}}};
     },
     53,
     {"tet"}},
    {"absorbing_inside_the_body",
     [](model::Case& c) {
       c.absorbing = {{line(16), "end", placed(plane(0, 0.3), 16)}};
     },
     16,
     {"boundary face"}},
    {"absorbing_twice",
     [](model::Case& c) {
       c.absorbing = {{line(16), "end", plane(1, 0)}, {line(17), "again", everything()}};
     },
     17,
     {"again", "another one has taken already"}},
    {"path_without_gauge",
     [](model::Case& c) {
       c.motions[0].path.emplace();
       c.motions[0].path->speed = 1, c.motions[0].path->turn = 1e-3;
       c.motions[0].path->targets = {{line(31), "strian", 1, ""}};
     },
     31,
     {"strian"}},
    {"path_of_no_motion",
     [](model::Case& c) {
       c.motions[0].path.emplace();
       c.motions[0].path->place = line(31), c.motions[0].path->of = "push";
     },
     31,
     {"there is no [[motion]] `push` with a path"}},
    {"joint_region_on_nothing",
     [](model::Case& c) {
       model::JointRegionSpec r;
       r.where = placed(box({5, 5, 5}, {6, 6, 6}), 15);
       c.joint_regions = {r};
     },
     15,
     {"joint"}},
};

class FaultyCase : public testing::TestWithParam<Fault> {};

// Requirement: every faulty case is refused as bad input at its place in the deck, and no folder is made.
TEST_P(FaultyCase, is_refused_at_its_place) {
  auto const& fault = GetParam();
  auto c = tie_case({4, 2, 2}, 1e-4, 1);
  c.concretes[0].place = line(9);
  fault.plant(c);
  output::testing::TemporaryFolder const folder;
  sim::RunOptions o;
  o.out = folder / "run";
  o.quiet = true;
  try {
    sim::run_case(c, o);
    ADD_FAILURE() << "the case was accepted";
  } catch (core::InputError const& e) {
    EXPECT_EQ(e.failure, core::Failure::input);
    ASSERT_FALSE(e.diagnostics.empty());
    bool at_line = fault.line == 0;
    for (auto const& d : e.diagnostics) at_line |= d.place.line == fault.line && d.place.file == "case.toml";
    EXPECT_TRUE(at_line) << e.what();
    for (auto const& word : fault.words)
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << word << " in: " << e.what();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.name()));
}
INSTANTIATE_TEST_SUITE_P(Faults, FaultyCase, testing::ValuesIn(faults),
                         [](auto const& i) { return std::string(i.param.name); });

// Requirement: the case the faults are planted in is itself sound.
TEST(FaultyCases, the_case_without_a_fault_runs) {
  auto c = tie_case({4, 2, 2}, 1e-5, 1);
  output::testing::TemporaryFolder const folder;
  sim::RunOptions o;
  o.out = folder / "run";
  o.quiet = true;
  EXPECT_EQ(sim::run_case(c, o).status, "complete");
}

} // namespace
} // namespace fissura::support
