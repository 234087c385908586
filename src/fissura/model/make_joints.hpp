#pragma once
#include "fissura/model/model.hpp"

namespace fissura::model {

/// Joints between all tets that share a face, except where both concretes have joints = false. Fills in
/// Model::joints and joint_of_shared_face.
void make_joints(Model& m);

/// The case's joint regions, resolved to shared faces.
class JointRegions {
 public:
  explicit JointRegions(Model const& m);
  /// Changes the strengths of the joint on a shared face by every region that holds it.
  void apply(int shared_face, laws::CohesiveInput& in) const;

 private:
  std::vector<JointRegionSpec> specs_;
  std::vector<std::vector<char>> member_; ///< per region: 1 for its shared faces
};

/// Law of the joint on a shared face: of the weaker neighbour where they differ, then changed by the joint
/// regions.
laws::CohesiveParams joint_law(Model const& m, JointRegions const& regions, int shared_face);

/// h of o_p = 2 h f_t/p by the option of the concrete: edge of the regular tet with the neighbours' mean
/// volume, mean edge of the triangle, or given [m].
double joint_size(Model const& m, int shared_face, ConcreteSpec const& concrete);

/// Traction along -normal of the mesh's most dangerous plane under uniaxial compression along any axis:
/// min over crackable joints of the stress at which f_s is reached [Pa], with the joint's angle [rad].
struct WeakestPlane {
  double stress = 0, angle = 0;
  int axis = 0;
};
WeakestPlane weakest_plane(Model const& m, int axis);

} // namespace fissura::model
