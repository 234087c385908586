#pragma once
// What changes in time in the reinforcement: histories, accounts and the last computed values of bar elements
// and bar joints, one entry per element or joint of model::Bars. BarState is all that a checkpoint holds of
// the bars.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fissura/core/vec3.hpp"
#include "fissura/laws/bar_joint.hpp"
#include "fissura/state/bar_lanes.hpp"

namespace fissura::state {

/// Where the energy of one bar joint went [J].
struct BarJointAccount {
  double bond_steel = 0; ///< bond slip and yielding
  double dowel = 0;      ///< damage of the dowel zone
  double rupture = 0;    ///< held when the bar broke
};

/// A bar joint as it moved last: what activation needs to know of the step before.
struct BarJointMotion {
  double axial = 0;           ///< d.r [m]
  double slip_from_start = 0; ///< S, from t = 0 [m]
  double t_1 = 0, t_2 = 0;    ///< half transverse jump in the joint's own directions, from t = 0 [m]
  double held =
      0; ///< while intact: energy of the joint and of the element halves that activation hands to it [J]
};

struct BarState {
  // per bar element
  std::vector<double> elongation;     ///< l - l_i [m]
  std::vector<double> element_stress; ///< N/A_s [Pa]
  // per bar joint
  std::vector<laws::BarJointHistory> history;
  std::vector<BarJointMotion> motion;
  std::vector<BarJointAccount> account;
  std::vector<double> joint_stress;    ///< of the bar at the crack [Pa]
  std::vector<double> joint_strain;    ///< of the bar at the crack [-]
  std::vector<double> slip;            ///< S since activation [m]; 0 while intact
  std::vector<double> normalised_slip; ///< s = (S/D) K_fc [-]
  std::vector<double> dowel_force;     ///< V_s [N]

  bool is_activated(std::size_t joint) const { return history[joint].activated; }
  bool has_yielded(std::size_t joint) const { return history[joint].yielded; }
  bool is_broken(std::size_t joint) const { return history[joint].ruptured; }
};

/// Work arrays of the bars.
struct BarScratch {
  /// A vector as packs write it: x, y, z, 0.
  struct Padded {
    double x = 0, y = 0, z = 0, pad = 0;
    Padded() = default;
    Padded(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
    operator Vec3() const { return {x, y, z}; }
  };
  struct Element {
    Padded direction;                ///< current, unit
    std::array<Padded, 3> gradients; ///< of the host's barycentric coordinates 1 to 3, now [1/m]
    Padded force;                    ///< N times direction: on P_0, its opposite on P_1 [N]
  };
  struct Joint {
    Padded r;                           ///< unit mean direction of the two bar elements
    Padded across_1, across_2;          ///< unit vectors normal to r and to each other
    double axial = 0;                   ///< d.r, with d = x_PB - x_PA [m]
    double t_1 = 0, t_2 = 0;            ///< half of d along across_1 and across_2: t_v of the theory [m]
    double may_separate = 0;            ///< 0 where the faces are surely intact, else 1
    std::array<double, 4> w_a{}, w_b{}; ///< weights of the point of attack in both tets as they are now
    Padded force;                       ///< on tet_a, its opposite on tet_b [N]
    double pull = 0;                    ///< sigma A_s [N]
  };
  /// One force that acts on a host tet.
  struct Entry {
    enum class Kind : std::uint8_t { element, side_a, side_b };
    Kind kind;
    int index;
  };
  struct Host {
    int tet, slot, begin, end; ///< entries[begin .. end)
  };
  std::vector<Element> element;
  std::vector<Joint> joint;
  std::vector<ElementLanes> element_lanes; ///< of eight elements each
  std::vector<BarJointLanes> joint_lanes;  ///< of eight joints each
  std::vector<CrossingLanes> crossing_lanes;
  std::vector<Host> hosts; ///< by tet
  std::vector<Entry> entries;
};

} // namespace fissura::state
