#include "fissura/sim/spots.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <tuple>

#include "fissura/core/finite.hpp"

namespace fissura::sim {

using model::Model;
using state::State;

namespace {

Vec3 centroid(Model const& m, int tet) {
  auto const x = mesh::corners(m.mesh, tet);
  return 0.25 * (x[0] + x[1] + x[2] + x[3]);
}

/// How many of the coordinates of a tet's nodes are not finite, in both fields.
int bad_numbers(State const& s, int tet) {
  int count = 0;
  auto const t = static_cast<std::size_t>(tet);
  for (int i = 0; i < core::per_tet; ++i) {
    count += !core::is_finite(s.u.of_tet(t)[i]);
    count += !core::is_finite(s.v.of_tet(t)[i]);
  }
  return count;
}

/// Mean number of them in a tet and its neighbours: largest where they spread from.
double share_of_bad(Model const& m, State const& s, int tet) {
  double sum = bad_numbers(s, tet), count = 1;
  for (int const f : m.adjacency.shared_of_tet[static_cast<std::size_t>(tet)]) {
    if (f < 0) continue;
    auto const& shared = m.adjacency.shared[static_cast<std::size_t>(f)];
    sum += bad_numbers(s, shared.a.tet == tet ? shared.b.tet : shared.a.tet);
    ++count;
  }
  return sum / count;
}

std::string number_of_copy(model::BarProperties const& bar, int copy) {
  return bar.copies > 1 ? fmt::format(", copy {}", copy) : std::string{};
}

Spot bar_spot(Model const& m, int bar, int copy, double along, int tet, std::string what, std::string field) {
  auto const& properties = m.bars.properties[static_cast<std::size_t>(bar)];
  Spot s;
  s.what = fmt::format("{} of bar `{}`{}, {:.4g} m from its start", what, properties.name,
                       number_of_copy(properties, copy), along);
  s.field = std::move(field);
  s.group = properties.name;
  s.tet = m.mesh.input_id[static_cast<std::size_t>(tet)];
  s.has_place = true;
  s.at = centroid(m, tet);
  return s;
}

} // namespace

Spot tet_spot(Model const& m, int tet, std::string field) {
  Spot s;
  auto const t = static_cast<std::size_t>(tet);
  s.tet = m.mesh.input_id[t];
  s.group = m.mesh.volume_groups[static_cast<std::size_t>(m.mesh.tet_group[t])];
  s.what = fmt::format("tet {} of group {}", s.tet, s.group);
  s.field = std::move(field);
  s.has_place = true;
  s.at = centroid(m, tet);
  return s;
}

Spot joint_spot(Model const& m, int joint, std::string field) {
  auto const& j = m.joints.joints[static_cast<std::size_t>(joint)];
  Spot s = tet_spot(m, j.node_a[0] / 4, std::move(field));
  s.what = fmt::format("joint {} between tets {} and {} of group {}", joint, s.tet,
                       m.mesh.input_id[static_cast<std::size_t>(j.node_b[0] / 4)], s.group);
  Vec3 sum;
  for (int const node : j.node_a) sum += m.position.at(static_cast<std::size_t>(node));
  s.at = (1.0 / 3) * sum;
  return s;
}

Spot bar_element_spot(Model const& m, std::size_t element, std::string field) {
  auto const& e = m.bars.elements[element];
  return bar_spot(m, e.bar, e.copy, e.start, e.tet, fmt::format("element {}", element), std::move(field));
}

Spot bar_joint_spot(Model const& m, std::size_t joint, std::string field) {
  auto const& j = m.bars.joints[joint];
  double const along = m.bars.elements[static_cast<std::size_t>(j.elem_b)].start;
  return bar_spot(m, j.bar, j.copy, along, j.tet_a, fmt::format("joint {}", joint), std::move(field));
}

Fastest fastest_tet(Model const& m, State const& s) {
  Fastest f;
  double largest = 0;
  for (std::size_t n = 0; n < 4 * static_cast<std::size_t>(m.tets.count); ++n) {
    double const square = dot(s.v.at(n), s.v.at(n));
    if (f.tet >= 0 && !(square > largest)) continue;
    largest = square;
    f.tet = static_cast<int>(n / 4);
  }
  f.speed = std::sqrt(largest);
  return f;
}

std::optional<Spot> find_non_finite_motion(Model const& m, State const& s) {
  std::vector<int> tets;
  Vec3 middle;
  for (int t = 0; t < m.tets.count; ++t) {
    if (bad_numbers(s, t) == 0) continue;
    middle += centroid(m, t);
    tets.push_back(t);
  }
  if (tets.empty()) return std::nullopt;
  middle = (1.0 / static_cast<double>(tets.size())) * middle;
  int source = tets[0];
  std::tuple<int, double, double> best{};
  for (int const t : tets) {
    std::tuple const rank{bad_numbers(s, t), share_of_bad(m, s, t), -norm(centroid(m, t) - middle)};
    if (rank > best) source = t, best = rank;
  }
  bool const moved = !core::all_finite(s.u.of_tet(static_cast<std::size_t>(source)), core::per_tet);
  return tet_spot(m, source, moved ? "displacement" : "velocity");
}

} // namespace fissura::sim
