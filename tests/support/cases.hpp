#pragma once
// Cases built in code, as a deck would describe them, for tests of the driver.
#include <string>
#include <utility>
#include <vector>

#include "fissura/sim/build_model.hpp"
#include "fissura/step/advance.hpp"
#include "support/reinforced_model.hpp"

namespace fissura::support {

inline model::Selector plane(int axis, double at) {
  model::Selector s;
  s.kind = model::Selector::Kind::plane;
  s.axis = axis, s.at = at;
  return s;
}
inline model::Selector box(Vec3 from, Vec3 to) {
  model::Selector s;
  s.kind = model::Selector::Kind::box;
  s.from = from, s.to = to;
  return s;
}
inline model::Selector everything() {
  return {};
}
inline model::Selector group(std::string name) {
  model::Selector s;
  s.kind = model::Selector::Kind::group;
  s.group = std::move(name);
  return s;
}

inline model::Curve constant(double value) {
  model::Curve c;
  c.value = value;
  return c;
}
inline model::Curve ramp(double value, double over) {
  model::Curve c;
  c.kind = model::Curve::Kind::ramp, c.value = value, c.over = over;
  return c;
}

inline model::BoxSpec box_of_cells(std::string name, Vec3 from, Vec3 to, std::array<int, 3> cells) {
  model::BoxSpec b;
  b.name = std::move(name);
  b.place = {"case.toml", 3, 1};
  b.from = from, b.to = to, b.cells = cells;
  return b;
}
inline model::SupportSpec support_at(std::string name, model::Selector where, std::array<bool, 3> fix) {
  return {{"case.toml", 20, 1}, std::move(name), std::move(where), fix};
}
inline model::MotionSpec motion_at(std::string name, model::Selector where, int axis, model::Curve curve,
                                   bool is_velocity = false) {
  model::MotionSpec m;
  m.place = {"case.toml", 30, 1};
  m.name = std::move(name), m.where = std::move(where), m.axis = axis, m.curve = std::move(curve);
  m.is_velocity = is_velocity;
  return m;
}
inline model::GaugeSpec gauge(std::string name, model::GaugeSpec::Kind kind) {
  model::GaugeSpec g;
  g.place = {"case.toml", 40, 1};
  g.name = std::move(name), g.kind = kind;
  return g;
}

/// A box from the origin, one concrete, nothing else.
inline model::Case box_case(std::array<int, 3> cells, Vec3 size, double end_time) {
  model::Case c;
  c.title = "test";
  c.deck_file = "case.toml";
  c.mesh.place = {"case.toml", 2, 1};
  c.mesh.boxes = {box_of_cells("concrete", {}, size, cells)};
  c.concretes = {plain_concrete()};
  c.run.end_time = end_time;
  c.output.frames = 2;
  c.output.history_points = 50;
  return c;
}

/// A reinforced tie that is pulled at x = length until it cracks.
inline model::Case tie_case(std::array<int, 3> cells, double end_time, double speed) {
  Vec3 const size{0.6, 0.1, 0.1};
  auto c = box_case(cells, size, end_time);
  c.steels = {plain_steel()};
  c.bars = {straight_bar({0, 0.05, 0.05}, {0.6, 0.05, 0.05}, 0.012)};
  c.bars[0].place = {"case.toml", 25, 1};
  c.supports = {support_at("left", plane(0, 0), {true, true, true})};
  c.motions = {motion_at("pull", plane(0, 0.6), 0, ramp(speed, 2e-4), true)};
  return c;
}

/// A case ready to be stepped by hand.
struct Stepper {
  sim::BuildReport report;
  model::Model m;
  state::State s;
  state::Scratch w;
  step::EnergyBalance e;
  explicit Stepper(model::Case const& c)
      : m(sim::build_model(c, report)), s(step::make_state(m)), w(step::make_scratch(m, s)) {}
  void advance(long steps = 1) {
    for (long i = 0; i < steps; ++i) step::advance(m, s, w);
  }
  step::EnergyBalance const& read() {
    step::advance(m, s, w, &e);
    return e;
  }
};

} // namespace fissura::support
