// What each cluster of a point weighs, now that some of its joints may have been released.
#include <algorithm>
#include <array>
#include <cmath>

#include "fissura/motion/points.hpp"

namespace fissura::motion {

using model::Model;
using state::JointStatus;
using state::PointRows;
using state::State;

namespace {

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

/// The joint at a face of a tet, or -1.
int joint_at(Model const& m, int tet, int face) {
  int const shared = m.adjacency.shared_of_tet[idx(tet)][idx(face)];
  return shared < 0 ? -1 : m.joint_of_shared_face[idx(shared)];
}

/// The node on the other side of a joint, or -1 where the joint is not at this node.
int partner(model::Joint const& j, int node) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (j.node_a[k] == node) return j.node_b[k];
    if (j.node_b[k] == node) return j.node_a[k];
  }
  return -1;
}

/// Visits (cluster, joint, cluster beyond it) of a point, clusters and their nodes and faces ascending.
template <class Visit> void visit_joints(Model const& m, std::size_t point, Visit const& visit) {
  auto const& p = m.points;
  for (int c = p.first[point]; c < p.first[point + 1]; ++c)
    for (int i = p.start[idx(c)]; i < p.start[idx(c + 1)]; ++i)
      for (int face = 0; face < 4; ++face) {
        int const node = p.node[idx(i)], joint = joint_at(m, node / 4, face);
        if (joint < 0) continue;
        int const beyond = partner(m.joints.joints[idx(joint)], node);
        if (beyond >= 0) visit(c, joint, p.cluster_of[idx(beyond)]);
      }
}

/// Numbers the parts into which released joints have split a point by their first clusters; returns how many
/// there are.
int find_parts(Model const& m, State const& s, PointRows& rows, std::size_t point) {
  int const first = m.points.first[point], end = m.points.first[point + 1];
  constexpr std::uint8_t most = 255; // more parts than tets can meet: those beyond stay together
  for (int c = first; c < end; ++c)
    rows.part[idx(c)] = static_cast<std::uint8_t>(std::min<int>(c - first, most));
  for (bool changed = true; changed;) {
    changed = false;
    visit_joints(m, point, [&](int a, int joint, int b) {
      if (!m.points.barred[idx(joint)] && state::status_of(s, joint) == JointStatus::released) return;
      auto const least = std::min(rows.part[idx(a)], rows.part[idx(b)]);
      changed |= rows.part[idx(a)] != least || rows.part[idx(b)] != least;
      rows.part[idx(a)] = rows.part[idx(b)] = least;
    });
  }
  std::array<int, most + 1> name;
  name.fill(-1);
  int count = 0;
  for (int c = first; c < end; ++c) {
    auto& part = rows.part[idx(c)];
    if (name[part] < 0) name[part] = count++;
    part = static_cast<std::uint8_t>(name[part]);
  }
  return count;
}

/// A cluster keeps the inertia of all joints it ever had for as long as one of them holds: the last one of
/// many, slid far off its place and with a lever, is stiffer than its share at rest.
void renew_point(Model const& m, State const& s, PointRows& rows, std::size_t point) {
  auto const& p = m.points;
  int const first = p.first[point], end = p.first[point + 1];
  for (int c = first; c < end; ++c) {
    auto& row = rows.row[idx(c)] = {};
    auto &mass = rows.mass[idx(c)] = 0, &weight = rows.weight[idx(c)] = 0;
    for (int i = p.start[idx(c)]; i < p.start[idx(c + 1)]; ++i) {
      auto const node = idx(p.node[idx(i)]);
      mass += m.mass[node];
      weight += m.mass[node] * m.tets.weight_ratio[node / 4];
    }
    row.mu = p.own[idx(c)];
  }
  visit_joints(m, point, [&](int cluster, int joint, int) {
    auto const j = idx(joint);
    rows.row[idx(cluster)].mu += joint_share * m.joints.k(j) * m.joints.joints[j].area / (3 * p.rate);
  });
  rows.parts[point] = static_cast<std::uint8_t>(end - first == 1 ? 1 : find_parts(m, s, rows, point));
  std::array<int, 256> members{};
  for (int c = first; c < end; ++c) ++members[rows.part[idx(c)]];
  double pull = 0, mu = 0;
  for (int c = first; c < end; ++c) {
    auto& row = rows.row[idx(c)];
    if (members[rows.part[idx(c)]] == 1) row.mu = 0; // nothing to be inert against
    row.inertia = rows.mass[idx(c)] + row.mu;
    row.inverse = 1 / row.inertia;
    row.beta = row.mu * row.inverse;
    pull += row.beta * rows.mass[idx(c)], mu += row.mu;
  }
  rows.per_pull[point] = pull > 0 ? 1 / pull : 0;
  rows.per_mu[point] = mu > 0 ? 1 / mu : 0;
}

/// Relative part of the kinetic energy of a point [J].
double energy_of(Model const& m, State const& s, PointRows const& rows, std::size_t point) {
  double energy = 0;
  for (int part = 0; part < rows.parts[point]; ++part) {
    Vec3 momentum;
    double mu = 0;
    for (int c = m.points.first[point]; c < m.points.first[point + 1]; ++c) {
      if (rows.part[idx(c)] != part) continue;
      auto const& row = rows.row[idx(c)];
      Vec3 const v = s.v.at(idx(m.points.leader[idx(c)]));
      momentum += row.mu * v, mu += row.mu;
      energy += 0.5 * row.mu * dot(v, v);
    }
    if (mu > 0) energy -= 0.5 * dot(momentum, momentum) / mu;
  }
  return energy;
}

} // namespace

PointRows make_rows(Model const& m, State const& s) {
  PointRows rows;
  auto const& p = m.points;
  if (!p.any()) return rows;
  rows.row.resize(p.start.size() - 1), rows.mass.resize(rows.row.size()), rows.weight.resize(rows.row.size());
  rows.part.assign(p.start.size() - 1, 0);
  rows.per_pull.resize(p.count()), rows.per_mu.resize(p.count()), rows.parts.assign(p.count(), 1);
  for (std::size_t i = 0; i < p.count(); ++i) renew_point(m, s, rows, i);
  for (std::size_t g = 0; g < s.joint_history.groups(); ++g)
    rows.released.push_back(state::count_lanes(s, g).released);
  rows.touched.reserve(6 * state::JointHistories::group);
  return rows;
}

double relative_energy(Model const& m, State const& s, PointRows const& rows) {
  double sum = 0;
  for (std::size_t i = 0; i < m.points.count(); ++i) sum += energy_of(m, s, rows, i);
  return sum;
}

double drop_released(Model const& m, State const& s, state::Scratch& w) {
  auto& rows = w.points;
  auto const& p = m.points;
  double lost = 0;
  for (std::size_t g = 0; g < rows.released.size(); ++g) {
    if (w.joints.lanes[g].released == rows.released[g]) continue;
    rows.released[g] = w.joints.lanes[g].released;
    rows.touched.clear();
    auto const from = state::JointHistories::first_of(g);
    for (std::size_t j = from; j < from + s.joint_history.room(g) && j < idx(m.joints.count); ++j)
      if (state::status_of(s, static_cast<int>(j)) == JointStatus::released)
        for (int const node : m.joints.joints[j].node_a) {
          int const c = p.cluster_of[idx(node)];
          rows.touched.push_back(
              static_cast<int>(std::upper_bound(p.first.begin(), p.first.end(), c) - p.first.begin()) - 1);
        }
    std::sort(rows.touched.begin(), rows.touched.end());
    rows.touched.erase(std::unique(rows.touched.begin(), rows.touched.end()), rows.touched.end());
    for (int const point : rows.touched) {
      double const before = energy_of(m, s, rows, idx(point));
      renew_point(m, s, rows, idx(point));
      lost += before - energy_of(m, s, rows, idx(point));
    }
  }
  return lost;
}

} // namespace fissura::motion
