#include "fissura/sim/state_hash.hpp"

#include <algorithm>

#include "fissura/core/hash.hpp"
#include "fissura/parallel/parallel.hpp"

namespace fissura::sim {

using model::Model;
using state::State;

namespace {

/// Modulo 2^64: the order does not matter.
struct Sum {
  std::uint64_t value = 0;
  Sum& operator+=(Sum b) {
    value += b.value;
    return *this;
  }
};

std::uint64_t input(Model const& m, int tet) {
  return static_cast<std::uint64_t>(m.mesh.input_id[tet]);
}

std::uint64_t tet_hash(Model const& m, State const& s, int t) {
  double record[32] = {};
  auto const tet = static_cast<std::size_t>(t);
  for (int a = 0; a < 4; ++a) {
    std::copy_n(s.u.of_node(4 * tet + a), 3, record + 4 * a);
    std::copy_n(s.v.of_node(4 * tet + a), 3, record + 16 + 4 * a);
  }
  for (double& x : record) x += 0.0; // -0 and +0 are the same state
  return core::hash_bytes(record, sizeof record, input(m, t));
}

std::uint64_t joint_hash(Model const& m, State const& s, int j) {
  if (s.joint_status[j] == 0) return 0;
  auto const& f = m.adjacency.shared[m.joints.joints[j].shared_face];
  double kappa[4] = {static_cast<double>(s.joint_status[j])};
  auto const history = s.joint_history.of(static_cast<std::size_t>(j));
  for (int q = 0; q < 3; ++q) kappa[q + 1] = history.point[q].kappa;
  std::sort(kappa + 1, kappa + 4);
  std::uint64_t const a = input(m, f.a.tet), b = input(m, f.b.tet);
  return core::hash_bytes(kappa, sizeof kappa, std::min(a, b) << 32 | std::max(a, b));
}

/// Sum of hash(i) over 0 .. count - 1.
template <class Hash> std::uint64_t sum_of(int count, Hash const& hash) {
  auto const n = static_cast<std::size_t>(count);
  std::size_t const grain = std::max<std::size_t>(512, n / 256 + 1); // few enough parts for sum_chunks
  return parallel::sum_chunks<Sum>(n, grain,
                                   [&](std::size_t begin, std::size_t end) {
                                     Sum sum;
                                     for (std::size_t i = begin; i < end; ++i)
                                       sum.value += hash(static_cast<int>(i));
                                     return sum;
                                   })
      .value;
}

} // namespace

std::uint64_t state_hash(Model const& m, State const& s) {
  std::uint64_t sum = static_cast<std::uint64_t>(s.step);
  sum += sum_of(m.tets.count, [&](int t) { return tet_hash(m, s, t); });
  sum += sum_of(m.joints.count, [&](int j) { return joint_hash(m, s, j); });
  for (std::size_t i = 0; i < s.rigid.body.size(); ++i) {
    auto const& b = s.rigid.body[i];
    double record[6] = {b.u.x, b.u.y, b.u.z, b.v.x, b.v.y, b.v.z};
    for (double& x : record) x += 0.0;
    sum += core::hash_bytes(record, sizeof record, ~static_cast<std::uint64_t>(i));
  }
  for (auto const& t : s.rigid.touch) {
    double record[4] = {t.offset, t.stretch.x, t.stretch.y, t.stretch.z};
    for (double& x : record) x += 0.0;
    sum += core::hash_bytes(record, sizeof record, ~(input(m, t.tet) << 16 | t.body));
  }
  return sum;
}

} // namespace fissura::sim
