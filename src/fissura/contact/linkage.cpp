#include "fissura/contact/linkage.hpp"

#include <algorithm>
#include <numeric>

namespace fissura::contact {

using model::Model;
using state::JointStatus;
using state::State;

namespace {

/// Sets of joined things; the smallest member stands for its set.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int a, int b) {
    a = find(a), b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<int> parent_;
};

/// Labels the tets around each point of a parted joint by the sets in which they still hold together.
void label_around_parted(Model const& m, State const& s, std::vector<char> const& is_split,
                         std::vector<int>& label) {
  // Corners at split points, as a compact list, joined across every face that holds.
  std::vector<int> corner, place(label.size(), -1);
  for (std::size_t t = 0; t < m.mesh.tets.size(); ++t)
    for (int c = 0; c < 4; ++c)
      if (is_split[m.mesh.tets[t][c]]) {
        place[4 * t + c] = static_cast<int>(corner.size());
        corner.push_back(static_cast<int>(4 * t) + c);
      }
  Sets sets(corner.size());
  for (std::size_t f = 0; f < m.adjacency.shared.size(); ++f) {
    auto const& face = m.adjacency.shared[f];
    bool asked = false, joined = false;
    for (int k = 0; k < 3; ++k) {
      int const a = place[4 * face.a.tet + face.corner_a[k]];
      if (a < 0) continue;
      if (!asked) asked = true, joined = holds(m, s, f);
      if (joined) sets.join(a, place[4 * face.b.tet + face.corner_b[k]]);
    }
  }
  for (std::size_t i = 0; i < corner.size(); ++i)
    label[corner[i]] = 1 + corner[sets.find(static_cast<int>(i))];
}

/// Whether two tets had a face in common whose joint has parted.
bool have_parted(Model const& m, State const& s, int tet_a, int tet_b) {
  for (int const f : m.adjacency.shared_of_tet[tet_a]) {
    if (f < 0) continue;
    auto const& face = m.adjacency.shared[f];
    if (face.a.tet == tet_b || face.b.tet == tet_b) return !holds(m, s, static_cast<std::size_t>(f));
  }
  return false;
}

} // namespace

bool holds(Model const& m, State const& s, std::size_t shared_face) {
  int const joint = m.joint_of_shared_face[shared_face];
  return joint < 0 || s.joint_status[joint] < static_cast<std::uint8_t>(JointStatus::parting);
}

Linkage find_linkage(Model const& m, State const& s) {
  Linkage link;
  Sets sets(m.mesh.tets.size());
  std::vector<char> is_split(m.mesh.points.size(), 0);
  bool any_parted = false;
  for (std::size_t f = 0; f < m.adjacency.shared.size(); ++f) {
    auto const& face = m.adjacency.shared[f];
    if (holds(m, s, f)) {
      sets.join(face.a.tet, face.b.tet);
      continue;
    }
    any_parted = true;
    for (int const c : face.corner_a) is_split[m.mesh.tets[face.a.tet][c]] = 1;
  }
  link.body.resize(m.mesh.tets.size());
  link.bodies = 0;
  for (std::size_t t = 0; t < link.body.size(); ++t) {
    int const root = sets.find(static_cast<int>(t));
    link.body[t] = root == static_cast<int>(t) ? link.bodies++ : link.body[root]; // roots come first
  }
  link.around_point.assign(4 * m.mesh.tets.size(), 0);
  if (any_parted) label_around_parted(m, s, is_split, link.around_point);
  return link;
}

bool are_linked(Model const& m, State const& s, Linkage const& link, int tet_a, int tet_b) {
  if (link.body[tet_a] != link.body[tet_b] || have_parted(m, s, tet_a, tet_b)) return false;
  auto const &a = m.mesh.tets[tet_a], &b = m.mesh.tets[tet_b];
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k)
      if (a[i] == b[k] && link.around_point[4 * tet_a + i] == link.around_point[4 * tet_b + k]) return true;
  return false;
}

std::vector<int> surface_tets(Model const& m, State const& s) {
  std::vector<int> tets;
  for (auto const& f : m.adjacency.boundary) tets.push_back(f.tet);
  for (std::size_t f = 0; f < m.adjacency.shared.size(); ++f)
    if (!holds(m, s, f)) {
      tets.push_back(m.adjacency.shared[f].a.tet);
      tets.push_back(m.adjacency.shared[f].b.tet);
    }
  std::sort(tets.begin(), tets.end());
  tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
  return tets;
}

} // namespace fissura::contact
