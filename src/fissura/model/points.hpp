#pragma once
// The copies of a mesh point, for models whose joints carry inertia (docs/theory/joint_inertia.md).
#include <array>
#include <cstdint>
#include <vector>

namespace fissura::model {

/// Point -> clusters -> copies. A copy is a node of a tet; a cluster holds copies that no joint separates and
/// that move as one; a point holds the clusters that joints hold together where tets meet at one place of the
/// mesh. Clusters and copies of a point ascend by node, so that sums over them are the same in every run.
/// Tets are cut into parts; first come the points whose tets all lie in part 0, then those of part 1, at the
/// end those that several parts share: a part's own points are moved while its tets are at hand.
/// Empty without joint inertia.
struct Points {
  static constexpr int tets_per_part = 1024; ///< what a processor keeps near it

  std::vector<int> first;   ///< point p: clusters first[p] .. first[p + 1] - 1
  std::vector<int> of_part; ///< part k: its own points of_part[k] .. of_part[k + 1] - 1; then the shared ones
  std::vector<int> start;   ///< cluster c: node[start[c]] .. node[start[c + 1] - 1]
  std::vector<int> node;    ///< every node once
  std::vector<int> leader;  ///< per cluster: its first node
  std::vector<int> cluster_of; ///< per node
  double rate = 0;             ///< r: the square of the frequency that no joint exceeds [1/s2]
  std::vector<double> own;     ///< per cluster: inertia for its tets and bars [kg]; joints come on top
  std::vector<std::uint8_t>
      barred;            ///< per joint: a bar goes through it, which pulls at its tets when it is gone
  std::vector<int> held; ///< per point: where its clusters begin in `prescribed`, or -1
  std::vector<std::array<int, 3>>
      prescribed; ///< per cluster of a held point and axis: Model::prescribed or -1

  bool any() const { return !first.empty(); }
  std::size_t count() const { return first.empty() ? 0 : first.size() - 1; }
};

} // namespace fissura::model
