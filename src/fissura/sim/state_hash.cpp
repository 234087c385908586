#include "fissura/sim/state_hash.hpp"

#include <algorithm>

#include "fissura/core/hash.hpp"

namespace fissura::sim {

std::uint64_t state_hash(model::Model const& m, state::State const& s) {
  std::uint64_t sum = static_cast<std::uint64_t>(s.step);
  auto input = [&](int tet) { return static_cast<std::uint64_t>(m.mesh.input_id[tet]); };
  for (int t = 0; t < m.tets.count; ++t) {
    double record[32];
    std::copy_n(s.u.data() + 16 * t, 16, record);
    std::copy_n(s.v.data() + 16 * t, 16, record + 16);
    for (double& x : record) x += 0.0; // -0 and +0 are the same state
    sum += core::hash_bytes(record, sizeof record, input(t));
  }
  for (int j = 0; j < m.joints.count; ++j) {
    if (s.joint_status[j] == 0) continue;
    auto const& f = m.adjacency.shared[m.joints.joints[j].shared_face];
    double kappa[4] = {static_cast<double>(s.joint_status[j])};
    for (int q = 0; q < 3; ++q) kappa[q + 1] = s.joint_history[j].point[q].kappa;
    std::sort(kappa + 1, kappa + 4);
    auto const [low, high] = std::minmax(input(f.a.tet), input(f.b.tet));
    sum += core::hash_bytes(kappa, sizeof kappa, low << 32 | high);
  }
  for (std::size_t i = 0; i < s.rigid.body.size(); ++i) {
    auto const& b = s.rigid.body[i];
    double record[6] = {b.u.x, b.u.y, b.u.z, b.v.x, b.v.y, b.v.z};
    for (double& x : record) x += 0.0;
    sum += core::hash_bytes(record, sizeof record, ~static_cast<std::uint64_t>(i));
  }
  for (auto const& t : s.rigid.touch) {
    double record[4] = {t.offset, t.stretch.x, t.stretch.y, t.stretch.z};
    for (double& x : record) x += 0.0;
    sum += core::hash_bytes(record, sizeof record, ~(input(t.tet) << 16 | t.body));
  }
  return sum;
}

} // namespace fissura::sim
