#pragma once
// Reinforcement cut by the mesh into bar elements and bar joints: geometry and parameters, nothing that
// changes in time.
#include <array>
#include <string>
#include <vector>

#include "fissura/core/vec3.hpp"
#include "fissura/laws/bar_joint.hpp"
#include "fissura/laws/bar_joint_uncracked.hpp"
#include "fissura/model/case.hpp"

namespace fissura::model {

/// What all elements of one BarSpec share.
struct BarProperties {
  std::string name;
  SteelSpec steel;
  double area = 0;           ///< A_s [m2] of one copy
  double diameter = 0;       ///< D [m]
  double initial_strain = 0; ///< eps_0 [-]
  SlipReduction slip_reduction = default_slip_reduction;
  CrackLength l_cr_from = CrackLength::automatic; ///< SlipReduction::paper
  double l_cr = 0;                                ///< [m] for CrackLength::given
  bool spacing_is_given = false;                  ///< of the cracks, by the deck
  std::vector<double> crack_spacing; ///< SlipReduction::consistent: per copy, distance of cracks [m]
  int copies = 1;                    ///< `count` for each line of its curve
};

/// The straight piece of a bar inside one tet. Its ends P_0 and P_1 are carried by the tet: x = sum w_k x_k.
/// They lie on the true axis of the bar, so a weight may be slightly negative (see docs/theory/bars.md).
struct BarElement {
  int tet = -1;
  std::array<double, 4> w0{}, w1{}; ///< barycentric weights of P_0 and P_1 in the tet
  Vec3 axis;                        ///< P_1 - P_0 at t = 0 [m]
  double length = 0;                ///< l_i [m]
  double start = 0;                 ///< arc length of P_0 from the start of the bar [m]
  int joint0 = -1, joint1 = -1;     ///< bar joint at P_0 and P_1, or -1
  int bar = -1;                     ///< index into Bars::properties
  int copy = 0;                     ///< 0 .. copies - 1
};

/// A face that the bar crosses at a bar joint (one of the faces C).
struct FaceCrossing {
  int shared_face = -1; ///< index into Adjacency::shared
  int joint = -1;       ///< the joint between its two tets: joint_of_shared_face
  std::array<double, 3>
      weights{};     ///< barycentric weights of the crossing, in the order of SharedFace::corner_a
  double cosine = 0; ///< |n.r| at t = 0
  double h = 0;      ///< edge of the regular tet with the mean volume of the two neighbours [m]
  /// Jump across the face below which it is surely intact [m]. Neither opening nor sliding exceeds the length
  /// of the jump, s_p is never below f_s/k, and strain rates only raise strengths: most faces need no more.
  double surely_intact = 0;
};

/// Where a bar passes from the tet of elem_a (its end P_1) to that of elem_b (its end P_0). P_A and P_B
/// coincide at t = 0. The two tets need not share a face.
struct BarJoint {
  int elem_a = -1, elem_b = -1;
  int tet_a = -1, tet_b = -1;
  std::array<double, 4> w_a{}, w_b{};  ///< weights of P_A in tet_a and of P_B in tet_b
  int faces_begin = 0, faces_end = 0;  ///< the faces C: Bars::faces[faces_begin .. faces_end)
  double length_a = 0, length_b = 0;   ///< L_1, L_2: lengths of the bar inside tet_a and tet_b [m]
  double h = 0;                        ///< mean element size of the faces C [m]
  std::array<int, 2> frame_edge{0, 1}; ///< corners of tet_a whose edge fixes the transverse directions
  int bar = -1, copy = 0;
};

/// The laws of a bar joint, before and after the concrete there has cracked.
struct BarJointLaw {
  laws::UncrackedBarJoint intact; ///< stress over d.r, without the prestress
  double prestress = 0;           ///< E_s eps_0, acts from the start [Pa]
  bool crackable = false;         ///< some face of C can open; else `activated` is empty
  laws::BarJointParams activated;
};

struct Bars {
  std::vector<BarProperties> properties; ///< per BarSpec
  std::vector<BarElement> elements;      ///< by bar, copy and arc length
  std::vector<BarJoint> joints;          ///< in the same order
  std::vector<FaceCrossing> faces;
  std::vector<BarJointLaw> joint_law; ///< per joint; rebar::set_bar_joint_laws fills it in
  BarSettings settings;
};

} // namespace fissura::model
