#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "fissura/sim/gauges.hpp"
#include "fissura/sim/stops.hpp"
#include "support/cases.hpp"

namespace fissura::support {
namespace {

using Kind = model::GaugeSpec::Kind;

/// A tie with everything that gauges can look at.
model::Case gauged_tie() {
  auto c = tie_case({4, 2, 2}, 1, 0.1);
  model::ForceSpec f;
  f.name = "push", f.where = plane(0, 0.6), f.direction = {0, 0, -2}, f.curve = constant(500);
  c.forces = {f};
  return c;
}

model::GaugeSpec displacement(std::string name, model::Selector where, int axis) {
  auto g = gauge(std::move(name), Kind::displacement);
  g.where = std::move(where), g.axis = axis;
  return g;
}
model::GaugeSpec line_gauge(Kind kind, Vec3 from, Vec3 to) {
  auto g = gauge("line", kind);
  g.from = from, g.to = to;
  return g;
}

/// Moves all tets whose centroid lies beyond x = at by (gap, 0, 0).
void open_gap(Stepper& x, double at, double gap) {
  for (int t = 0; t < x.m.tet_count(); ++t) {
    auto const c = mesh::corners(x.m.mesh, t);
    if (0.25 * (c[0].x + c[1].x + c[2].x + c[3].x) < at) continue;
    for (int a = 0; a < 4; ++a) set_node(x.s.u, model::node_of(t, a), {gap, 0, 0});
  }
}

/// Mean of f over all nodes at x = at: a point counts as often as tets share it.
template <class F> double mean_at(model::Model const& m, double at, F f) {
  double sum = 0, count = 0;
  for (int n = 0; n < node_count(m); ++n)
    if (Vec3 const X = position(m, n); std::abs(X.x - at) < 1e-9) sum += f(X), ++count;
  return sum / count;
}

// Requirement: a displacement gauge reads the mean over all points it selects, times its factor; velocity
// likewise.
TEST(Gauges, displacement_and_velocity_are_means) {
  auto c = gauged_tie();
  c.gauges = {displacement("u", plane(0, 0.6), 2), displacement("v", plane(0, 0.6), 2)};
  c.gauges[0].factor = -2;
  c.gauges[1].kind = Kind::velocity;
  Stepper x(c);
  sim::Gauges g(x.m);
  set_field(x.m, x.s.u, [](Vec3 X) { return Vec3{0, 0, X.x < 0.5 ? 9 : 0.06 + X.y - 0.05}; });
  set_field(x.m, x.s.v, [](Vec3 X) { return Vec3{0, 0, X.x < 0.5 ? 9 : 4 + X.z - 0.05}; });
  g.read_state(x.m, x.s);
  EXPECT_NEAR(g.values()[0], -2 * mean_at(x.m, 0.6, [](Vec3 X) { return 0.06 + X.y - 0.05; }), 1e-15);
  EXPECT_LT(g.values()[0], -0.02); // so neither zero nor the other sign passes
  EXPECT_NEAR(g.values()[1], mean_at(x.m, 0.6, [](Vec3 X) { return 4 + X.z - 0.05; }), 1e-13);
  EXPECT_EQ(g.find("v"), 1);
  EXPECT_EQ(g.find("w"), -1);
  EXPECT_EQ(g.columns()[0].unit, "m");
  EXPECT_EQ(g.columns()[1].unit, "m/s");
}

// Requirement: the reaction gauge sums the named supports and motions along its axis, and forces read their
// value.
TEST(Gauges, reaction_and_force) {
  auto c = gauged_tie();
  auto r = gauge("both", Kind::reaction), f = gauge("applied", Kind::force);
  r.of = {"left", "pull"}, r.axis = 0;
  f.of = {"push"}, f.axis = 2;
  c.gauges = {r, f};
  Stepper x(c);
  sim::Gauges g(x.m);
  for (std::size_t i = 0; i < x.m.prescribed.size(); ++i)
    x.s.reaction[i] = std::pow(10, static_cast<double>(i));
  g.read_forces(x.m, x.s, 0);
  EXPECT_EQ(g.values()[0], 1 + 1000); // left holds x, y, z; pull moves x
  EXPECT_NEAR(g.values()[1], -500, 1e-9);
  EXPECT_EQ(g.columns()[0].unit, "N");
}

// Requirement: a crack-width gauge reads an imposed gap, wherever its line runs: through the body, along mesh
// lines, on the faces and edges of the body, in either direction; and it reads 0 where there is none.
TEST(Gauges, crack_width_is_the_imposed_gap) {
  std::vector<std::pair<double, double>> const lines{{0.031, 0.043}, {0.05, 0.05}, {0.05, 0.02}, {0, 0.03},
                                                     {0.1, 0.03},    {0.03, 0},    {0.03, 0.1},  {0, 0},
                                                     {0.1, 0},       {0, 0.1},     {0.1, 0.1}};
  for (auto const& [y, z] : lines)
    for (bool const forwards : {true, false}) {
      SCOPED_TRACE(testing::Message() << "y = " << y << ", z = " << z << (forwards ? "" : ", backwards"));
      auto c = gauged_tie();
      Vec3 const a{0.01, y, z}, b{0.59, y, z};
      c.gauges = {line_gauge(Kind::crack_width, forwards ? a : b, forwards ? b : a)};
      Stepper x(c);
      std::optional<sim::Gauges> g;
      ASSERT_NO_THROW(g.emplace(x.m));
      g->read_state(x.m, x.s);
      EXPECT_EQ(g->values()[0], 0);
      open_gap(x, 0.3, 2e-4);
      g->read_state(x.m, x.s);
      EXPECT_NEAR(g->values()[0], 2e-4, 1e-12);
      set_field(x.m, x.s.u, [](Vec3) { return Vec3{1, 2, 3}; });
      g->read_state(x.m, x.s);
      EXPECT_NEAR(g->values()[0], 0, 1e-12) << "a body that moves as one has no crack";
    }
}

// Requirement: mean strain is the elongation between the two ends over their distance.
TEST(Gauges, mean_strain) {
  auto c = gauged_tie();
  c.gauges = {line_gauge(Kind::mean_strain, {0.15, 0.05, 0.05}, {0.45, 0.05, 0.05})};
  Stepper x(c);
  sim::Gauges g(x.m);
  set_field(x.m, x.s.u, [](Vec3 X) { return Vec3{2e-3 * X.x + 0.5, 0.1, 0}; });
  g.read_state(x.m, x.s);
  EXPECT_NEAR(g.values()[0], 2e-3, 1e-12);
}

// Requirement: bar gauges read the element or joint nearest to their place, each quantity with its unit.
TEST(Gauges, bars) {
  auto c = gauged_tie();
  std::vector<std::pair<std::string, std::string>> const quantities{
      {"stress", "Pa"}, {"joint_stress", "Pa"},   {"joint_strain", "-"},
      {"slip", "m"},    {"normalised_slip", "-"}, {"dowel_force", "N"}};
  for (auto const& [quantity, unit] : quantities) {
    auto g = gauge(quantity, Kind::bar);
    g.bar = "bar", g.quantity = quantity, g.from = {0.31, 0.05, 0.05};
    c.gauges.push_back(g);
  }
  Stepper x(c);
  sim::Gauges g(x.m);
  auto& b = x.s.bars;
  auto centre = [&](std::size_t i) {
    auto const& e = x.m.bars.elements[i];
    return e.start + 0.5 * e.length;
  };
  std::size_t nearest = 0, joint = 0;
  for (std::size_t i = 0; i < x.m.bars.elements.size(); ++i)
    if (std::abs(centre(i) - 0.31) < std::abs(centre(nearest) - 0.31)) nearest = i;
  auto place = [&](std::size_t i) {
    return x.m.bars.elements[static_cast<std::size_t>(x.m.bars.joints[i].elem_b)].start;
  };
  for (std::size_t i = 0; i < x.m.bars.joints.size(); ++i)
    if (std::abs(place(i) - 0.31) < std::abs(place(joint) - 0.31)) joint = i;
  b.element_stress[nearest] = 1, b.joint_stress[joint] = 2, b.joint_strain[joint] = 3, b.slip[joint] = 4;
  b.normalised_slip[joint] = 5, b.dowel_force[joint] = 6;
  g.read_forces(x.m, x.s, 0);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(g.values()[i], static_cast<double>(i + 1)) << quantities[i].first;
    EXPECT_EQ(g.columns()[i].unit, quantities[i].second);
  }
}

// Requirement: a gauge with zero_at reads relative to its reading when that stage began.
TEST(Gauges, are_zeroed_at_a_stage) {
  auto c = gauged_tie();
  c.stages = {{{}, "first", 1}, {{}, "second", 1}};
  c.gauges = {displacement("u", plane(0, 0.6), 2)};
  c.gauges[0].zero_at = "second";
  Stepper x(c);
  sim::Gauges g(x.m);
  auto read = [&](double u) {
    set_field(x.m, x.s.u, [&](Vec3) { return Vec3{0, 0, u}; });
    g.read_state(x.m, x.s);
    return g.values()[0];
  };
  EXPECT_NEAR(read(0.5), 0.5, 1e-15);
  set_field(x.m, x.s.u, [&](Vec3) { return Vec3{0, 0, 0.7}; });
  x.s.stage = 1;
  g.begin_stage(x.m, x.s);
  EXPECT_NEAR(read(0.8), 0.1, 1e-15);
}

// Requirement: contact force and impulse are those of the bodies on the concrete, summed; an impactor's
// displacement and velocity are its own.
TEST(Gauges, rigid_bodies) {
  auto c = gauged_tie();
  c.planes = {{{}, "floor", {0, 0, -1}, {0, 0, 1}, 0.6}};
  model::ImpactorSpec ball;
  ball.name = "ball", ball.centre = {0, 0, 2}, ball.radius = 0.5, ball.mass = 3, ball.velocity = {0, 0, -7};
  c.impactors = {ball};
  for (auto const kind :
       {Kind::contact_force, Kind::contact_impulse, Kind::impactor_displacement, Kind::impactor_velocity}) {
    auto g = gauge("g" + std::to_string(c.gauges.size()), kind);
    g.of = {"ball"}, g.axis = 2;
    if (c.gauges.size() < 2) g.of.push_back("floor");
    c.gauges.push_back(g);
  }
  Stepper x(c);
  sim::Gauges g(x.m);
  EXPECT_EQ(x.s.rigid.body[1].v.z, -7);
  x.s.rigid.body[0] = {{}, {}, {1, 2, 30}, {4, 5, 60}};
  x.s.rigid.body[1] = {{0, 0, -8}, {0, 0, -7}, {1, 2, -3}, {4, 5, -6}};
  g.read_state(x.m, x.s);
  g.read_forces(x.m, x.s, 0);
  EXPECT_EQ(g.values(), (std::vector<double>{27, 54, -8, -7}));
  EXPECT_EQ(g.columns()[1].unit, "N s");
}

// Requirement: gauges that name what is not there are refused, all at once, each at its place.
TEST(Gauges, refuse_what_is_not_there) {
  auto c = gauged_tie();
  auto r = gauge("r", Kind::reaction);
  r.of = {"nobody"};
  auto axis = gauge("axis", Kind::reaction);
  axis.of = {"pull"}, axis.axis = 2;
  auto bar = gauge("b", Kind::bar);
  bar.bar = "bar", bar.copy = 3, bar.quantity = "stress";
  c.gauges = {r,
              axis,
              bar,
              line_gauge(Kind::crack_width, {5, 5, 5}, {6, 5, 5}),
              line_gauge(Kind::mean_strain, {0.1, 0, 0}, {0.1, 0, 0}),
              line_gauge(Kind::mean_strain, {0, 0, 0}, {1e-3, 0, 0}),
              displacement("u", plane(0, 7), 0)};
  for (std::size_t i = 0; i < c.gauges.size(); ++i)
    c.gauges[i].place.line = c.gauges[i].where.place.line = 40 + static_cast<int>(i);
  Stepper x(c);
  try {
    sim::Gauges const g(x.m);
    FAIL() << "no error";
  } catch (core::InputError const& e) {
    ASSERT_EQ(e.diagnostics.size(), c.gauges.size());
    for (std::size_t i = 0; i < c.gauges.size(); ++i)
      EXPECT_EQ(e.diagnostics[i].place.line, 40 + static_cast<int>(i));
    EXPECT_NE(e.diagnostics[0].message.find("nobody"), std::string::npos);
  }
}

// Requirement: the motion of an impactor is that of one impactor: not of a plane, nor of two bodies.
TEST(Gauges, follow_one_impactor) {
  auto c = gauged_tie();
  c.planes = {{{}, "floor", {0, 0, -1}, {0, 0, 1}, 0.6}};
  model::ImpactorSpec ball;
  ball.name = "ball", ball.centre = {0, 0, 2}, ball.radius = 0.5, ball.mass = 3;
  c.impactors = {ball};
  for (auto const& of : std::vector<std::vector<std::string>>{{"floor"}, {"ball", "floor"}}) {
    auto g = gauge("g", Kind::impactor_velocity);
    g.of = of;
    c.gauges = {g};
    Stepper x(c);
    try {
      sim::Gauges const gauges(x.m);
      FAIL() << "no error";
    } catch (core::InputError const& e) {
      EXPECT_NE(std::string(e.what()).find("`of` must name one impactor"), std::string::npos) << e.what();
    }
  }
}

// ---- stops
// -------------------------------------------------------------------------------------------------------

struct StopCase {
  Stepper x;
  sim::Gauges g;
  sim::Stops stops;
  static model::Case with(model::StopSpec stop) {
    auto c = gauged_tie();
    c.gauges = {displacement("u", plane(0, 0.6), 2)};
    stop.gauge = "u";
    c.stops = {stop};
    return c;
  }
  explicit StopCase(model::StopSpec const& stop) : x(with(stop)), g(x.m), stops(x.m.source, g) {}
  std::optional<std::string> at(double u) {
    set_field(x.m, x.s.u, [&](Vec3) { return Vec3{0, 0, u}; });
    g.read_state(x.m, x.s);
    return stops.met(g);
  }
};

// Requirement: limits above and below end the run when passed, not when touched, and say what happened, in an
// engineer's units.
TEST(Stops, limits) {
  model::StopSpec spec;
  spec.has_above = true, spec.above = 1;
  spec.has_below = true, spec.below = -1;
  StopCase c(spec);
  EXPECT_FALSE(c.at(0.999));
  EXPECT_FALSE(c.at(-0.999));
  ASSERT_TRUE(c.at(1.001));
  EXPECT_EQ(*c.at(1.001), "u = 1001 mm rose above 1000 mm");
  ASSERT_TRUE(c.at(-1.001));
  EXPECT_NE(c.at(-1.001)->find("fell below"), std::string::npos);
}

// Requirement: "fallen to a share of its peak" counts sizes, and only once the peak has exceeded `after`.
TEST(Stops, fall_from_the_peak) {
  model::StopSpec spec;
  spec.falls_to = 0.8, spec.after = 10;
  StopCase c(spec);
  EXPECT_FALSE(c.at(-5));
  EXPECT_FALSE(c.at(-1)); // fell, but before the peak counted
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(c.at(-20));
  EXPECT_FALSE(c.at(-2)); // a spike of one reading: the mean of five is 16.4
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(c.at(-20));
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(c.at(-15.5));
  auto const reason = c.at(-15.5);
  ASSERT_TRUE(reason);
  EXPECT_NE(reason->find("20"), std::string::npos);
}

// Requirement: a stop that names no gauge is refused at its place.
TEST(Stops, refuse_unknown_gauges) {
  auto c = gauged_tie();
  model::StopSpec spec;
  spec.place = {"case.toml", 77, 1}, spec.gauge = "nothing";
  c.stops = {spec};
  Stepper x(c);
  sim::Gauges const g(x.m);
  try {
    sim::Stops const s(c, g);
    FAIL();
  } catch (core::InputError const& e) {
    EXPECT_EQ(e.diagnostics[0].place.line, 77);
  }
}

} // namespace
} // namespace fissura::support
