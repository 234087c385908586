// A number that is not finite, a tet inside out, a node that flies off: found soon, and named by its place.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include <nlohmann/json.hpp>

#include "fissura/checkpoint/walk.hpp"
#include "fissura/sim/guards.hpp"
#include "fissura/sim/monitor.hpp"
#include "fissura/sim/run.hpp"
#include "fissura/sim/spots.hpp"
#include "fissura/sim/state_hash.hpp"
#include "support/cases.hpp"
#include "unit/output/temporary_folder.hpp"

namespace fissura::support {
namespace {

double const nan = std::numeric_limits<double>::quiet_NaN();
double const infinity = std::numeric_limits<double>::infinity();

/// A tie that cracks, with every kind of history in use: bars, strain rates, a body that lies on it, an
/// impactor, a floor, a path, a load, dashpots, gravity, all kinds of damping.
model::Case everything_at_once() {
  auto c = tie_case({6, 2, 2}, 1, 1.5);
  c.concretes[0].rate_factor = model::RateFactor::mc2010;
  c.concretes[0].mu_bar = 1e4;
  c.run.mass_damping = 10, c.run.local_damping = 0.01;
  c.gravity.on = true, c.gravity.curve = constant(9.81);
  c.mesh.boxes[0].body = "tie";
  auto lid = box_of_cells("lid", {0.2, 0, 0.1}, {0.3, 0.1, 0.15}, {1, 1, 1});
  lid.body = "lid";
  c.mesh.boxes.push_back(lid);
  c.initial_velocities = {{{}, group("lid"), {0, 0, -1}}};
  model::ImpactorSpec ball;
  ball.name = "ball", ball.centre = {0.45, 0.05, 0.15}, ball.radius = 0.05, ball.mass = 1;
  ball.velocity = {0, 0, -2};
  c.impactors = {ball};
  c.planes = {{{}, "floor", {0, 0, 0}, {0, 0, 1}, 0.6}};
  model::ForceSpec load;
  load.place = {"case.toml", 50, 1}, load.name = "load", load.where = plane(0, 0.6),
  load.direction = {0, 0, 1};
  load.curve = constant(10);
  c.forces = {load};
  auto u = gauge("u", model::GaugeSpec::Kind::displacement);
  u.where = plane(0, 0.6);
  c.gauges = {u};
  model::PathSpec path;
  path.speed = 1e-3, path.turn = 1e-4, path.targets = {{{}, "u", 1, "1 m"}};
  auto side = motion_at("side", box({0, 0, 0}, {0.01, 0, 0.1}), 1, constant(0), true);
  side.path = path;
  c.supports[0].fix = {true, false, true};
  c.motions.push_back(side);
  return c;
}

/// The scene when joints are damaged and broken, bars slip and bodies touch.
std::unique_ptr<Stepper> scene() {
  auto x = std::make_unique<Stepper>(everything_at_once());
  for (int i = 0; i < 4000; ++i) {
    x->advance();
    if (concrete::count_joints(x->m, x->s).damaged > 0 && x->s.bars.history[4].activated &&
        !x->s.contact.pairs.empty() && !x->s.rigid.touch.empty())
      break;
  }
  concrete::set_damage(x->m, x->s, x->m.joint_count() - 1, 1);
  x->w = step::make_scratch(x->m, x->s);
  x->advance();
  return x;
}

std::size_t first_with(state::State const& s, bool (*wanted)(std::uint8_t)) {
  std::size_t j = 0;
  while (!wanted(s.joint_status[j])) ++j;
  return j;
}
std::size_t first_damaged(state::State const& s) {
  return first_with(s, [](std::uint8_t status) { return status != 0; });
}
std::size_t first_broken(state::State const& s) {
  return first_with(
      s, [](std::uint8_t status) { return status == static_cast<std::uint8_t>(state::JointStatus::broken); });
}

/// The k-th number of a damaged joint's history.
double* history_number(state::State& s, std::size_t joint, int k) {
  constexpr auto group = state::JointHistories::group;
  std::size_t const place = joint / group * group + s.joint_history.lane[joint];
  return &s.joint_history.rows[place / model::block].row[static_cast<std::size_t>(k)][place % model::block];
}

struct Plant {
  std::string name;
  double* number;
};

/// `bars.history[].bond.K` for `bars.history[17].bond.K`.
std::string without_indices(std::string const& path) {
  std::string all;
  bool inside = false;
  for (char const c : path) {
    if (c == ']') inside = false;
    if (!inside) all += c;
    if (c == '[') inside = true;
  }
  return all;
}

/// One of each kind of floating number that State holds, found through the description that checkpoints are
/// written by, which cannot leave one out. Of a list an item in the middle, of the bars' joints one that
/// slips, of nodes some, of joints the histories of a damaged and of a broken one.
std::vector<Plant> all_numbers(state::State& s) {
  std::map<std::string, std::vector<Plant>> kinds;
  checkpoint::walk_numbers(s, "", [&](double& number, std::string const& path) {
    kinds[without_indices(path)].push_back({path, &number});
    return false;
  });
  std::vector<Plant> all;
  std::size_t slips = 0;
  while (!s.bars.history[slips].activated) ++slips;
  for (auto const& [name, items] : kinds) {
    if (name.starts_with("joint_history")) continue;
    if (name == "u.values[]" || name == "v.values[]")
      for (std::size_t const i : {0U, 1U, 2U, 101U, 202U}) all.push_back(items[i]);
    else if (std::string const joint = "bars.history[" + std::to_string(slips) + "]";
             name.starts_with("bars.history["))
      all.push_back(*std::find_if(items.begin(), items.end(),
                                  [&](Plant const& p) { return p.name.starts_with(joint); }));
    else
      all.push_back(items[items.size() == s.bars.history.size() ? slips : items.size() / 2]);
  }
  for (int k = 0; k < state::JointHistory::doubles; ++k) {
    all.push_back({"damaged[" + std::to_string(k) + "]", history_number(s, first_damaged(s), k)});
    all.push_back({"broken[" + std::to_string(k) + "]", history_number(s, first_broken(s), k)});
  }
  return all;
}

/// What the guards say within ten steps of the planting.
std::optional<sim::Trouble> guard(Stepper& x) {
  sim::Guards const guards(x.m);
  for (long i = 0; i < sim::Guards::interval; ++i) {
    x.advance();
    if (auto found = guards.after_step(x.m, x.s)) return found;
  }
  return std::nullopt;
}

constexpr std::size_t parts = 8; // of the plants, so that several processors share the work

class NotFinite : public testing::TestWithParam<std::size_t> {};

// Requirement: a number that is not finite, in whatever field of the state, is found within ten steps and its
// place is named. Fields that each step computes anew may lose it instead: then nothing has changed.
TEST_P(NotFinite, is_found_within_ten_steps) {
  auto const untouched = scene();
  std::size_t const count = all_numbers(untouched->s).size();
  EXPECT_GT(count, 160U);
  ASSERT_FALSE(sim::Guards(untouched->m).look_everywhere(untouched->m, untouched->s));
  untouched->advance(sim::Guards::interval);
  for (std::size_t i = GetParam(); i < count; i += parts) {
    auto const x = scene();
    auto const plant = all_numbers(x->s)[i];
    SCOPED_TRACE(plant.name);
    *plant.number = plant.name[1] == '.' ? infinity : nan; // of a node or any other
    auto const found = guard(*x);
    if (found) {
      EXPECT_EQ(found->kind, "not_finite");
      EXPECT_FALSE(sim::describe(found->spot).empty());
      EXPECT_FALSE(found->cause.empty() || found->cure.empty());
    } else {
      EXPECT_FALSE(sim::Guards(x->m).look_everywhere(x->m, x->s));
      EXPECT_EQ(sim::state_hash(x->m, x->s), sim::state_hash(untouched->m, untouched->s));
    }
  }
}
INSTANTIATE_TEST_SUITE_P(AnyField, NotFinite, testing::Range(std::size_t{0}, parts));

// Requirement: before a state is kept for good every number of it is looked at: wherever one stands that is
// not finite, it is found without a step, and something is named.
TEST(Guards, look_at_every_number) {
  auto const x = scene();
  for (auto const& plant : all_numbers(x->s)) {
    SCOPED_TRACE(plant.name);
    double const before = *plant.number;
    *plant.number = nan;
    auto const found = sim::Guards(x->m).look_everywhere(x->m, x->s);
    ASSERT_TRUE(found);
    EXPECT_FALSE(sim::describe(found->spot).empty());
    EXPECT_NE(found->spot.what, "the energies"); // what is said where nothing was found
    *plant.number = before;
  }
}

// Requirement: the pace of the loads and how far they are ahead are looked at as everything else is.
TEST(Guards, look_at_the_pace) {
  auto const x = scene();
  for (double* const number : {&x->s.pace, &x->s.pace_growth, &x->s.lead, &x->s.time}) {
    double const before = *number;
    *number = nan;
    EXPECT_FALSE(sim::idle_memory_is_finite(x->m, x->s));
    EXPECT_EQ(sim::find_non_finite_memory(x->m, x->s)->what, "the loads' time");
    *number = before;
  }
}

// Requirement: the tet that is named is the one where the number stood, or one to which a joint or a bar has
// carried it in the same step: at most one cell away.
TEST(Guards, name_the_tet_where_it_began) {
  for (int const tet : {3, 40, 77}) {
    auto const x = scene();
    x->s.u(model::node_of(tet, 1), 1) = nan;
    auto const found = guard(*x);
    ASSERT_TRUE(found);
    ASSERT_TRUE(found->spot.has_place);
    auto const c = mesh::corners(x->m.mesh, tet);
    EXPECT_LT(norm(found->spot.at - 0.25 * (c[0] + c[1] + c[2] + c[3])), 0.11)
        << found->spot.tet; // cells of 0.1 m
    auto const text = sim::describe(*found);
    for (char const* part : {"tet ", " of group ", " at (", ") m, t = ", "Likely cause: ", "Cure: "})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

// Requirement: a joint's history and a bar's are named by their own ids.
TEST(Guards, name_joints_and_bars) {
  auto const x = scene();
  auto const j = first_damaged(x->s);
  double& time_of_failure = *history_number(x->s, j, 29);
  time_of_failure = nan;
  auto spot = sim::find_non_finite_memory(x->m, x->s);
  ASSERT_TRUE(spot);
  EXPECT_EQ(sim::describe(*spot).find("the history of joint " + std::to_string(j) + " between tets "), 0u);
  time_of_failure = 0;
  x->s.bars.account[2].dowel = nan;
  spot = sim::find_non_finite_memory(x->m, x->s);
  ASSERT_TRUE(spot);
  EXPECT_NE(sim::describe(*spot).find("of joint 2 of bar `bar`, "), std::string::npos)
      << sim::describe(*spot);
  EXPECT_EQ(spot->group, "bar");
}

/// Moves one corner of a tet through the opposite face.
void turn_inside_out(Stepper& x, int tet) {
  auto const corners = mesh::corners(x.m.mesh, tet);
  Vec3 const opposite = (1.0 / 3) * (corners[1] + corners[2] + corners[3]);
  for (int r = 0; r < 3; ++r) x.s.u(model::node_of(tet, 0), r) = 1.5 * (opposite - corners[0])[r];
}

// Requirement: a tet that is turned inside out is named at the next reading of the energies, by either law.
TEST(Guards, name_a_tet_that_is_inside_out) {
  for (auto law : {model::TetLaw::hyperelastic, model::TetLaw::paper}) {
    auto c = tie_case({4, 1, 1}, 1, 1);
    c.concretes[0].tet_law = law;
    Stepper x(c);
    turn_inside_out(x, 7);
    sim::Monitor monitor(x.m);
    auto found = sim::inverted_tet(x.m, x.s);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->spot.tet, x.m.mesh.input_id[7]);
    EXPECT_NE(found->what.find("volume is -0.5 of"), std::string::npos) << found->what;
    x.e = step::read_stored(x.m, x.s);
    found = monitor.take(x.e, x.m, x.s);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->kind, "inverted_tet");
  }
}

// Requirement: a node faster than sound in the concrete ends the run; a fast one that is slower does not.
TEST(Guards, name_a_runaway) {
  auto speed = [](double v) {
    auto x = std::make_unique<Stepper>(tie_case({4, 1, 1}, 1, 1));
    x->s.v(model::node_of(11, 0), 0) = v;
    x->s.ledger.kinetic_before = 1e9;
    x->s.step = sim::Guards::interval;
    return sim::Guards(x->m).after_step(x->m, x->s);
  };
  EXPECT_FALSE(speed(3000));
  auto const found = speed(4000);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, "runaway");
  EXPECT_NE(found->what.find("4000 m/s"), std::string::npos) << found->what;
}

// Requirement: a time step that is too large ends in a failed run that names a place; run.json has the parts,
// and the last frame shows the fields as they were.
TEST(Guards, leave_a_picture_of_a_failed_run) {
  output::testing::TemporaryFolder const folder;
  auto c = tie_case({4, 1, 1}, 1, 1);
  c.run.dt = 2e-4;
  c.output.frames = 1;
  sim::RunOptions o;
  o.out = folder / "run", o.quiet = true, o.threads = 1;
  auto const result = sim::run_case(c, o);
  EXPECT_EQ(result.status, "failed");
  auto const j = nlohmann::json::parse(output::testing::read_bytes(folder / "run/run.json"));
  EXPECT_EQ(j["status"], "failed");
  EXPECT_EQ(j["reason"], result.reason);
  auto const& failure = j["failure"];
  for (char const* key : {"kind", "what", "where", "tet", "group", "time", "step", "cause", "cure", "frame"})
    EXPECT_TRUE(failure.contains(key)) << key;
  std::string const frame = failure["frame"];
  EXPECT_TRUE(std::filesystem::is_regular_file(folder / ("run/" + frame))) << frame;
}

} // namespace
} // namespace fissura::support
