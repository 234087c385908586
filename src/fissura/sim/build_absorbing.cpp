#include <algorithm>
#include <fmt/core.h>
#include <map>
#include <numeric>
#include <set>

#include "fissura/model/impedance.hpp"
#include "fissura/model/select.hpp"
#include "fissura/sim/build_model.hpp"

namespace fissura::sim {

using model::Model;

namespace {

/// Node -> the smallest node that moves with it, and that -> all of them.
class Clusters {
 public:
  explicit Clusters(Model const& m) : bonding_(m.bonding), cluster_of_(m.bonding.node.size(), -1) {
    for (std::size_t c = 0; c + 1 < bonding_.start.size(); ++c)
      for (int i = bonding_.start[c]; i < bonding_.start[c + 1]; ++i)
        cluster_of_[static_cast<std::size_t>(bonding_.node[static_cast<std::size_t>(i)])] =
            static_cast<int>(c);
  }
  int first(int node) const { return bonding_.any ? members(node).front() : node; }
  std::vector<int> members(int node) const {
    if (!bonding_.any) return {node};
    auto const c = static_cast<std::size_t>(cluster_of_[static_cast<std::size_t>(node)]);
    return {bonding_.node.begin() + bonding_.start[c], bonding_.node.begin() + bonding_.start[c + 1]};
  }

 private:
  model::Bonding const& bonding_;
  std::vector<int> cluster_of_;
};

/// A third of each face's dashpots on the cluster of each of its nodes.
std::map<int, Mat3> lumped_dashpots(Model const& m, Clusters const& clusters) {
  std::map<int, Mat3> damping;
  std::set<std::pair<int, int>> seen;
  std::map<int, model::SixBySix> stiffness;
  for (auto const& spec : m.source.absorbing)
    for (auto const& face : model::select_boundary_faces(m.mesh, m.adjacency, spec.where)) {
      if (!seen.insert({face.tet, face.face}).second)
        throw core::InputError(spec.place, fmt::format("[[absorbing]] `{}` takes a face that another one has "
                                                       "taken already",
                                                       spec.name));
      auto const& corner = mesh::face_corners[face.face];
      auto const x = mesh::corners(m.mesh, face.tet);
      Vec3 const area = 0.5 * cross(x[corner[1]] - x[corner[0]], x[corner[2]] - x[corner[0]]);
      int const concrete = m.material_of_tet[face.tet];
      if (!stiffness.contains(concrete)) stiffness[concrete] = model::jointed_stiffness(m, concrete);
      double const density =
          m.source.concretes[concrete].density / m.tets.weight_ratio[static_cast<std::size_t>(face.tet)];
      Mat3 const z = model::impedance(model::acoustic_tensor(stiffness[concrete], unit(area)), density);
      for (int const c : corner) {
        Mat3& sum = damping[clusters.first(model::node_of(face.tet, c))];
        sum = sum + (norm(area) / 3) * z;
      }
    }
  return damping;
}

/// What a support or motion holds feels no dashpot.
void free_the_held(Model const& m, Clusters const& clusters, std::map<int, Mat3>& damping) {
  for (auto const& p : m.prescribed)
    for (int const node : p.nodes) {
      auto const found = damping.find(clusters.first(node));
      if (found == damping.end()) continue;
      found->second[p.axis] = Vec3{};
      for (auto& row : found->second.row) row[p.axis] = 0;
    }
}

} // namespace

void build_absorbing(Model& m) {
  if (m.source.absorbing.empty()) return;
  Clusters const clusters(m);
  auto damping = lumped_dashpots(m, clusters);
  free_the_held(m, clusters, damping);
  auto& a = m.absorbing;
  for (auto const& [first, matrix] : damping) {
    auto const nodes = clusters.members(first);
    double mass = 0, real = 0;
    for (int const n : nodes) {
      mass += m.mass[n];
      real += m.mass[n] * m.tets.weight_ratio[static_cast<std::size_t>(n / 4)];
    }
    int const begin = static_cast<int>(a.node.size());
    a.node.insert(a.node.end(), nodes.begin(), nodes.end());
    a.patches.push_back({begin, static_cast<int>(a.node.size()), matrix, mass, real / mass});
  }
}

} // namespace fissura::sim
