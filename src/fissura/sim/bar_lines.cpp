// Bars for the eye: one polyline per bar, which filters of ParaView such as Tube take at once.
#include <algorithm>

#include "fissura/sim/fields.hpp"

namespace fissura::sim {

using model::Model;
using output::Array;
using output::Grid;
using state::State;

namespace {

/// Points of a line belong to bar elements, two to each: its values stand at both of its ends, so that they
/// are exact along it and may jump from one element to the next. What lies between two elements is the bar
/// joint, whose values stand at the two points beside it.
struct PointFields {
  std::vector<float> displacement, radius, stress, strain, joint_stress, joint_strain, slip, normalised;
  std::vector<std::int32_t> joint, yielded, broken;

  void add_joint(State const& s, int number) {
    auto const& b = s.bars;
    auto const j = static_cast<std::size_t>(number);
    bool const any = number >= 0;
    joint.push_back(number);
    joint_stress.push_back(any ? static_cast<float>(b.joint_stress[j]) : 0.0F);
    joint_strain.push_back(any ? static_cast<float>(b.joint_strain[j]) : 0.0F);
    slip.push_back(any ? static_cast<float>(b.slip[j]) : 0.0F);
    normalised.push_back(any ? static_cast<float>(b.normalised_slip[j]) : 0.0F);
    yielded.push_back(any && b.has_yielded(j));
    broken.push_back(any && b.is_broken(j));
  }
  std::vector<Array> arrays() const {
    return {{"displacement", 3, displacement, "m"},
            {"radius", 1, radius, "m"},
            {"stress", 1, stress, "Pa"},
            {"strain", 1, strain, "-"},
            {"joint", 1, joint, "-"},
            {"joint_stress", 1, joint_stress, "Pa"},
            {"joint_strain", 1, joint_strain, "-"},
            {"slip", 1, slip, "m"},
            {"normalised_slip", 1, normalised, "-"},
            {"yielded", 1, yielded, "-"},
            {"broken", 1, broken, "-"}};
  }
};

void append(std::vector<float>& to, Vec3 v) {
  for (int r = 0; r < 3; ++r) to.push_back(static_cast<float>(v[r]));
}

struct Carried {
  Vec3 position, displacement;
};
Carried carried(Model const& m, State const& s, int tet, std::array<double, 4> const& weights) {
  Carried c;
  for (int a = 0; a < 4; ++a) {
    c.position += weights[a] * m.position.at(model::node_of(tet, a));
    c.displacement += weights[a] * s.u.at(model::node_of(tet, a));
  }
  return c;
}

/// Whether the bar runs on from one element to the next one: not across a gap in the concrete, nor where it
/// has ruptured.
bool runs_on(State const& s, model::BarElement const& from, model::BarElement const& to, Vec3 end,
             Vec3 start) {
  if (from.bar != to.bar || from.copy != to.copy) return false;
  if (from.joint1 >= 0 && from.joint1 == to.joint0)
    return !s.bars.is_broken(static_cast<std::size_t>(from.joint1));
  return norm(end - start) <= 1e-6 * std::min(from.length, to.length); // bonded: no joint between them
}

/// What the numbers of bars stand for: the bar's name, the cage or curve of the mesh it comes from, its
/// steel.
std::vector<output::Names> names(Model const& m) {
  output::Names bars{"bar_names", {}}, groups{"group_names", {}}, steels{"steel_names", {}};
  for (auto const& b : m.source.bars) {
    bars.names.push_back(b.name);
    groups.names.push_back(b.cage.empty() ? b.curve : b.cage);
    steels.names.push_back(b.steel);
  }
  return {bars, groups, steels};
}

} // namespace

Grid bar_lines(Model const& m, State const& s) {
  Grid g;
  PointFields fields;
  std::vector<std::int32_t> bar, copy;
  std::vector<float> diameter;
  auto const& elements = m.bars.elements;
  Vec3 last;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    auto const& e = elements[i];
    auto const& properties = m.bars.properties[static_cast<std::size_t>(e.bar)];
    Carried begin = carried(m, s, e.tet, e.w0);
    Carried const end = carried(m, s, e.tet, e.w1);
    bool const goes_on = i > 0 && runs_on(s, elements[i - 1], e, last, begin.position);
    // Both sides of a joint are one place; what rounding leaves between them would be a direction to a
    // filter.
    if (goes_on) begin.position = last;
    for (Carried const& p : {begin, end}) {
      g.connectivity.push_back(static_cast<std::int64_t>(g.points.size()));
      g.points.push_back(p.position);
      append(fields.displacement, p.displacement);
      fields.radius.push_back(static_cast<float>(properties.diameter / 2));
      fields.stress.push_back(static_cast<float>(s.bars.element_stress[i]));
      fields.strain.push_back(
          static_cast<float>(s.bars.elongation[i] / e.length + properties.initial_strain));
    }
    fields.add_joint(s, e.joint0), fields.add_joint(s, e.joint1);
    last = end.position;
    if (goes_on) {
      g.offsets.back() += 2;
      continue;
    }
    g.offsets.push_back(static_cast<std::int64_t>(g.points.size()));
    g.types.push_back(output::cell_type::poly_line);
    bar.push_back(e.bar), copy.push_back(e.copy);
    diameter.push_back(static_cast<float>(properties.diameter));
  }
  g.point_data = fields.arrays();
  g.cell_data = {{"bar", 1, bar, "-"}, {"copy", 1, copy, "-"}, {"diameter", 1, diameter, "m"}};
  g.names = names(m);
  return g;
}

} // namespace fissura::sim
