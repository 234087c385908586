#include "fissura/sim/fragments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "fissura/output/json.hpp"

namespace fissura::sim {

using model::Model;
using state::State;

namespace {

/// A sum that keeps what rounding loses (Neumaier): the masses of a million equal tets add up to 1e-15.
class Sum {
 public:
  void add(double x) {
    double const next = sum_ + x;
    lost_ += std::abs(sum_) >= std::abs(x) ? (sum_ - next) + x : (x - next) + sum_;
    sum_ = next;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

bool joins(Model const& m, State const& s, std::size_t shared_face) {
  int const joint = m.joint_of_shared_face[shared_face];
  return joint < 0 || static_cast<state::JointStatus>(s.joint_status[joint]) < state::JointStatus::broken;
}

/// Disjoint sets of tets; the root of a set is its smallest tet.
class Bodies {
 public:
  Bodies(Model const& m, State const& s)
      : parent_(static_cast<std::size_t>(m.tets.count)), count_(m.tets.count) {
    std::iota(parent_.begin(), parent_.end(), 0);
    for (std::size_t f = 0; f < m.adjacency.shared.size(); ++f)
      if (joins(m, s, f)) join(m.adjacency.shared[f].a.tet, m.adjacency.shared[f].b.tet);
  }
  int count() const { return count_; }
  int root(int tet) {
    while (parent_[tet] != tet) tet = parent_[tet] = parent_[parent_[tet]];
    return tet;
  }

 private:
  void join(int tet_a, int tet_b) {
    int const a = root(tet_a), b = root(tet_b);
    if (a == b) return;
    parent_[std::max(a, b)] = std::min(a, b);
    --count_;
  }
  std::vector<int> parent_;
  int count_;
};

/// Sums over the nodes of one body.
struct Totals {
  Sum mass, inertia, kinetic;
  std::array<Sum, 3> moment, momentum;

  void add(Model const& m, State const& s, int node, double weight_ratio) {
    double const inertial = m.mass[node], real = inertial * weight_ratio;
    mass.add(real), inertia.add(inertial);
    double squared = 0;
    for (int r = 0; r < 3; ++r) {
      double const v = s.v(node, r);
      moment[r].add(real * (m.position(node, r) + s.u(node, r)));
      momentum[r].add(inertial * v);
      squared += v * v;
    }
    kinetic.add(inertial * squared / 2);
  }
  Fragment body() const {
    Fragment f;
    f.mass = mass.value();
    for (int r = 0; r < 3; ++r) {
      f.centroid[r] = moment[r].value() / f.mass;
      f.velocity[r] = momentum[r].value() / inertia.value();
    }
    f.kinetic_energy = kinetic.value();
    return f;
  }
};

/// Numbers the bodies by falling mass, then by their smallest input number: the same for any order of the
/// tets.
void sort_by_mass(Fragments& f) {
  std::vector<int> order(f.bodies.size()), rank(f.bodies.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    auto const &x = f.bodies[a], &y = f.bodies[b];
    return x.mass != y.mass ? x.mass > y.mass : x.first_id < y.first_id;
  });
  std::vector<Fragment> sorted;
  sorted.reserve(order.size());
  for (int const i : order) {
    rank[i] = static_cast<int>(sorted.size());
    sorted.push_back(f.bodies[i]);
  }
  f.bodies = std::move(sorted);
  for (int& body : f.of_tet) body = rank[body];
}

void mark_held_by_bars(Fragments& f, Model const& m, State const& s) {
  for (std::size_t j = 0; j < m.bars.joints.size(); ++j) {
    int const a = f.of_tet[m.bars.joints[j].tet_a], b = f.of_tet[m.bars.joints[j].tet_b];
    if (a == b || s.bars.is_broken(j)) continue;
    f.bodies[a].held_by_bars = f.bodies[b].held_by_bars = true;
  }
}

} // namespace

double Fragments::mass() const {
  Sum sum;
  for (auto const& f : bodies) sum.add(f.mass);
  return sum.value();
}

Fragments find_fragments(Model const& m, State const& s) {
  Bodies bodies(m, s);
  Fragments f;
  f.of_tet.resize(static_cast<std::size_t>(m.tets.count));
  std::vector<int> number(f.of_tet.size(), -1), tets, first;
  std::vector<Totals> totals;
  for (int t = 0; t < m.tets.count; ++t) {
    int& body = number[bodies.root(t)];
    if (body < 0) {
      body = static_cast<int>(totals.size());
      totals.emplace_back(), tets.push_back(0), first.push_back(m.mesh.input_id[t]);
    }
    f.of_tet[t] = body;
    ++tets[body];
    first[body] = std::min(first[body], m.mesh.input_id[t]);
    for (int a = 0; a < 4; ++a) totals[body].add(m, s, model::node_of(t, a), m.tets.weight_ratio[t]);
  }
  for (std::size_t i = 0; i < totals.size(); ++i) {
    f.bodies.push_back(totals[i].body());
    f.bodies.back().tets = tets[i];
    f.bodies.back().first_id = first[i];
  }
  sort_by_mass(f);
  mark_held_by_bars(f, m, s);
  return f;
}

int FragmentCount::operator()(Model const& m, State const& s, int broken) {
  if (broken != counted_at_) {
    count_ = Bodies(m, s).count();
    counted_at_ = broken;
  }
  return count_;
}

output::Json fragments_json(Fragments const& fragments) {
  auto vector = [](Vec3 v) { return output::Json::array({v.x, v.y, v.z}); };
  output::Json largest = output::Json::array();
  for (std::size_t i = 0; i < std::min<std::size_t>(20, fragments.bodies.size()); ++i) {
    auto const& f = fragments.bodies[i];
    output::Json one = output::Json::object();
    one["mass"] = f.mass;
    one["tets"] = f.tets;
    one["centroid"] = vector(f.centroid);
    one["velocity"] = vector(f.velocity);
    one["kinetic_energy"] = f.kinetic_energy;
    one["held_by_bars"] = f.held_by_bars;
    largest.push_back(one);
  }
  output::Json j = output::Json::object();
  j["count"] = fragments.bodies.size();
  j["mass"] = fragments.mass();
  j["largest"] = largest;
  return j;
}

} // namespace fissura::sim
