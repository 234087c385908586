#pragma once
// The hot, immutable data of the step, in blocks of 8 tets or joints (one block size for every instruction
// set). Tet t owns nodes 4t..4t+3.
#include <array>
#include <cstdint>
#include <vector>

#include "fissura/core/buffer.hpp"
#include "fissura/core/vec3.hpp"
#include "fissura/laws/cohesive.hpp"
#include "fissura/mesh/mesh.hpp"
#include "fissura/model/shared_rows.hpp"

namespace fissura::model {

inline constexpr int block = 8;
constexpr std::size_t blocks_for(std::size_t n) {
  return (n + block - 1) / block;
}

/// Position of entry `component` of item i in an array laid out as [block][components][8].
constexpr std::size_t at(std::size_t i, int component, int components) {
  return (i / block * components + component) * block + i % block;
}

/// Number of the node that is corner `corner` of tet `tet`.
constexpr int node_of(int tet, int corner) {
  return 4 * tet + corner;
}

struct TetBlocks {
  int count = 0;                      ///< tets; padding lanes have volume 0 and inverse mass 0
  core::Buffer<double> gradient;      ///< [block][9][8] reference gradients of N_1, N_2, N_3 [1/m]
  core::Buffer<double> volume;        ///< [block][8] [m3]
  core::Buffer<double> inverse_mass;  ///< [block][4][8] of the node (of its cluster where bonded) [1/kg]
  core::Buffer<double> weight_ratio;  ///< [block][8] real mass / scaled mass: what gravity acts on
  SharedRows<3, block> moduli;        ///< G [Pa], lambda [Pa], mu_bar [Pa s]
  std::vector<std::uint8_t> is_paper; ///< [block][8] 1 for tets of the law `paper`, else 0
  bool any_viscosity = false;
  bool any_scaled = false; ///< some weight_ratio is not 1

  std::size_t blocks() const { return blocks_for(static_cast<std::size_t>(count)); }
  double shear_modulus(std::size_t tet) const { return moduli(tet, 0); } ///< G [Pa]
  double lame(std::size_t tet) const { return moduli(tet, 1); }          ///< lambda [Pa]
  double viscosity(std::size_t tet) const { return moduli(tet, 2); }     ///< mu_bar [Pa s]
};

/// One joint element: its place in the mesh. Corners k of side a and b coincide at t = 0.
struct Joint {
  int shared_face = -1;
  std::array<int, 3> node_a{}, node_b{};
  double area = 0, h = 0; ///< [m2], [m]
};

struct JointBlocks {
  int count = 0;
  core::Buffer<int> node;         ///< [block][6][8] where the nodes a0 a1 a2 b0 b1 b2 start in a NodeField
  core::Buffer<float> edge;       ///< [block][6][8] reference edges 0->1, 0->2 of the triangle [m]. They only
                                  ///< turn the normal, so half the digits do, and half the memory
  core::Buffer<double> stiffness; ///< [block][2][8] k [Pa/m], area/6 [m2]
  SharedRows<5, block> limits;    ///< 1/(4 f_t), shear limit, tan phi, 1/(4 f_s), and the tension beyond
                                  ///< which the full law is asked, where strengths depend on the strain rate
  bool any_rate = false;          ///< some strength depends on the strain rate
  std::vector<Joint> joints;
  std::vector<laws::CohesiveParams> kinds; ///< the laws that occur, for a stiffness of 1
  std::vector<std::uint16_t> kind;         ///< per joint

  std::size_t blocks() const { return blocks_for(static_cast<std::size_t>(count)); }
  /// Adds a joint with its law.
  void add(Joint const& joint, laws::CohesiveParams const& law);
  double k(std::size_t joint) const { return stiffness[at(joint, 0, 2)]; }
  laws::CohesiveParams law(int joint) const {
    auto const j = static_cast<std::size_t>(joint);
    return laws::with_stiffness(kinds[kind[j]], k(j));
  }
};

/// Nodes that move as one because no joint separates them (materials with joints = false).
struct Bonding {
  std::vector<int> start; ///< cluster c holds node[start[c]] .. node[start[c+1]-1], ascending
  std::vector<int> node;
  bool any = false;
};

} // namespace fissura::model
