#include "fissura/model/make_points.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace fissura::model {

namespace {

/// The smallest member is the root of its set.
struct Sets {
  std::vector<int> parent;

  explicit Sets(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0); }
  int root(int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(int a, int b) {
    a = root(a), b = root(b);
    parent[std::max(a, b)] = std::min(a, b);
  }
};

/// Numbers the sets by their roots, ascending; per node its set.
std::vector<int> number(Sets& sets, int& count) {
  std::vector<int> of(sets.parent.size());
  count = 0;
  for (std::size_t i = 0; i < of.size(); ++i) {
    int const root = sets.root(static_cast<int>(i));
    of[i] = root == static_cast<int>(i) ? count++ : of[static_cast<std::size_t>(root)];
  }
  return of;
}

/// Numbers points anew by parts (Points); per part where its points begin.
std::vector<int> sort_by_part(std::vector<int>& point_of, int points) {
  int const tets = static_cast<int>(point_of.size() / 4),
            parts = (tets + Points::tets_per_part - 1) / Points::tets_per_part;
  std::vector<int> part(static_cast<std::size_t>(points), -1);
  for (std::size_t n = 0; n < point_of.size(); ++n) {
    int& p = part[static_cast<std::size_t>(point_of[n])];
    int const here = static_cast<int>(n / 4) / Points::tets_per_part;
    p = p < 0 || p == here ? here : parts;
  }
  std::vector<int> order(static_cast<std::size_t>(points)), number(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return part[static_cast<std::size_t>(a)] < part[static_cast<std::size_t>(b)];
  });
  std::vector<int> begin(static_cast<std::size_t>(parts) + 1, 0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    for (int k = part[static_cast<std::size_t>(order[i])] + 1; k <= parts; ++k)
      begin[static_cast<std::size_t>(k)] = static_cast<int>(i) + 1;
  }
  for (int& p : point_of) p = number[static_cast<std::size_t>(p)];
  return begin;
}

void find_prescribed(Model& m) {
  auto& p = m.points;
  std::vector<int> point_of(p.start.size() - 1);
  for (std::size_t i = 0; i < p.count(); ++i)
    std::fill(point_of.begin() + p.first[i], point_of.begin() + p.first[i + 1], static_cast<int>(i));
  p.held.assign(p.count(), -1);
  for (std::size_t k = 0; k < m.prescribed.size(); ++k)
    for (int const node : m.prescribed[k].nodes) {
      int const cluster = p.cluster_of[static_cast<std::size_t>(node)];
      auto const point = static_cast<std::size_t>(point_of[static_cast<std::size_t>(cluster)]);
      if (p.held[point] < 0) {
        p.held[point] = static_cast<int>(p.prescribed.size());
        p.prescribed.resize(p.prescribed.size() +
                                static_cast<std::size_t>(p.first[point + 1] - p.first[point]),
                            {-1, -1, -1});
      }
      auto const at = static_cast<std::size_t>(p.held[point] + cluster - p.first[point]);
      p.prescribed[at][static_cast<std::size_t>(m.prescribed[k].axis)] = static_cast<int>(k);
    }
}

} // namespace

void make_points(Model& m) {
  std::size_t const nodes = 4 * static_cast<std::size_t>(m.tets.count);
  Sets points(nodes), clusters(nodes);
  for (std::size_t f = 0; f < m.adjacency.shared.size(); ++f) {
    auto const& face = m.adjacency.shared[f];
    for (int k = 0; k < 3; ++k) {
      int const a = node_of(face.a.tet, face.corner_a[k]), b = node_of(face.b.tet, face.corner_b[k]);
      points.join(a, b);
      if (m.joint_of_shared_face[f] < 0) clusters.join(a, b);
    }
  }
  int point_count = 0, cluster_count = 0;
  auto point_of = number(points, point_count);
  auto const cluster = number(clusters, cluster_count);
  auto of_part = sort_by_part(point_of, point_count);

  // by point, then cluster, then node
  std::vector<int> order(nodes);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    auto const x = static_cast<std::size_t>(a), y = static_cast<std::size_t>(b);
    return std::tuple{point_of[x], cluster[x], a} < std::tuple{point_of[y], cluster[y], b};
  });
  auto& p = m.points = {};
  p.node = std::move(order), p.of_part = std::move(of_part);
  p.cluster_of.resize(nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    auto const n = static_cast<std::size_t>(p.node[i]);
    bool const new_point = i == 0 || point_of[n] != point_of[static_cast<std::size_t>(p.node[i - 1])];
    if (new_point || cluster[n] != cluster[static_cast<std::size_t>(p.node[i - 1])]) {
      if (new_point) p.first.push_back(static_cast<int>(p.start.size()));
      p.start.push_back(static_cast<int>(i));
      p.leader.push_back(p.node[i]);
    }
    p.cluster_of[n] = static_cast<int>(p.start.size()) - 1;
  }
  p.first.push_back(static_cast<int>(p.start.size()));
  p.start.push_back(static_cast<int>(nodes));
  p.own.assign(p.start.size() - 1, 0);
  p.barred.assign(static_cast<std::size_t>(m.joints.count), 0);
  for (auto const& crossing : m.bars.faces)
    if (int const joint = m.joint_of_shared_face[static_cast<std::size_t>(crossing.shared_face)]; joint >= 0)
      p.barred[static_cast<std::size_t>(joint)] = 1;
  find_prescribed(m);
}

} // namespace fissura::model
