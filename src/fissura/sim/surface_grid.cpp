// The surface of the body as it is now: its outer faces, and both faces of every crack.
#include "fissura/sim/fields.hpp"
#include "fissura/sim/fragments.hpp"
#include "fissura/sim/joint_fields.hpp"

namespace fissura::sim {

using model::Model;
using output::Grid;
using state::State;

namespace {

class Surface {
 public:
  Surface(Model const& m, State const& s)
      : m_(m), s_(s), fragment_(find_fragments(m, s).of_tet),
        point_(4 * static_cast<std::size_t>(m.tets.count), -1) {}

  /// Adds the face of a tet; `joint`: the one that it is a side of, or -1.
  void add(int tet, mesh::FaceCorners const& corners, int joint) {
    for (auto const c : corners) grid_.connectivity.push_back(point(model::node_of(tet, c)));
    grid_.offsets.push_back(static_cast<std::int64_t>(grid_.connectivity.size()));
    grid_.types.push_back(output::cell_type::triangle);
    crack_.push_back(joint >= 0);
    group_.push_back(m_.mesh.tet_group[tet]);
    fragment_of_.push_back(fragment_[static_cast<std::size_t>(tet)]);
    if (joint >= 0)
      joints_.add(m_, s_, joint);
    else
      joints_.add_none();
  }
  Grid grid() {
    grid_.point_data = {{"displacement", 3, displacement_, "m"}};
    grid_.cell_data = joints_.arrays();
    grid_.cell_data.insert(grid_.cell_data.begin(), {"crack", 1, crack_, "-"});
    grid_.cell_data.push_back({"group", 1, group_, "-"});
    grid_.cell_data.push_back({"fragment", 1, fragment_of_, "-"});
    grid_.names = {{"group_names", m_.mesh.volume_groups}};
    return std::move(grid_);
  }

 private:
  std::int64_t point(int node) {
    auto& number = point_[static_cast<std::size_t>(node)];
    if (number >= 0) return number;
    number = static_cast<std::int64_t>(grid_.points.size());
    grid_.points.push_back(m_.position.at(node));
    Vec3 const u = s_.u.at(node);
    for (int r = 0; r < 3; ++r) displacement_.push_back(static_cast<float>(u[r]));
    return number;
  }
  Model const& m_;
  State const& s_;
  std::vector<int> fragment_;
  std::vector<std::int64_t> point_; ///< of each node, or -1
  Grid grid_;
  JointFields joints_;
  std::vector<float> displacement_;
  std::vector<std::int32_t> crack_, group_, fragment_of_;
};

} // namespace

Grid surface_grid(Model const& m, State const& s) {
  Surface surface(m, s);
  for (auto const& face : m.adjacency.boundary)
    surface.add(face.tet, mesh::face_corners[static_cast<std::size_t>(face.face)], -1);
  for (int j = 0; j < m.joints.count; ++j) {
    if (!is_cracked(s, j)) continue;
    auto const& joint = m.joints.joints[static_cast<std::size_t>(j)];
    auto const& shared = m.adjacency.shared[static_cast<std::size_t>(joint.shared_face)];
    surface.add(shared.a.tet, mesh::face_corners[static_cast<std::size_t>(shared.a.face)], j);
    surface.add(shared.b.tet, mesh::face_corners[static_cast<std::size_t>(shared.b.face)], j);
  }
  return surface.grid();
}

} // namespace fissura::sim
