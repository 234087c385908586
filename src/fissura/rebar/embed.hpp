#pragma once
// Embeds bars in the mesh: cuts every bar into bar elements, one per tet it passes, and bar joints between
// them (Eqs. 3-5, Fig. 2 of the founding paper; docs/theory/bars.md for bars along edges and faces of the
// mesh).
#include <span>
#include <string>
#include <vector>

#include "fissura/mesh/mesh.hpp"
#include "fissura/model/bars.hpp"
#include "fissura/model/case.hpp"

namespace fissura::rebar {

/// What became of one BarSpec, all its copies together. A curve of several lines has so many copies more:
/// copy number k is line k mod lines, moved k / lines times.
struct BarReport {
  std::string name;
  int copies = 0;
  double length_given = 0; ///< [m]
  double length_kept = 0;  ///< sum of the bar elements' lengths [m]
  double steel_mass = 0;   ///< rho_s A_s l [kg]
  int elements = 0, joints = 0;
  int dropped = 0;           ///< slivers shorter than 0.05 of the cell size
  double shortest = 0;       ///< shortest bar element [m]
  double largest_weight = 0; ///< largest barycentric weight of a bar end: 1 = the bar hangs on one node
};

struct EmbeddingReport {
  std::vector<BarReport> bars; ///< per BarSpec
  double length() const;       ///< kept, all bars [m]
  double steel_mass() const;   ///< [kg]
};

struct Embedding {
  model::Bars bars;
  EmbeddingReport report;
  std::vector<std::string> warnings;
};

/// The length of bar that each side of a joint stands for, l_g = (L_1 + L_2)/4 [m].
double length_of_face(model::BarJoint const& joint);
/// Half the length of bar over which a crack is fed, the paper's l_cr [m]: l_g, or h/2 of the faces, or as
/// given.
double crack_length(model::BarProperties const& bar, model::BarJoint const& joint);

/// Embeds all bars. joint_of_shared_face: per shared face its joint, or -1 where the two tets are bonded: a
/// bar has no bar joint there. Bars are taken in order, copies in order, each by arc length: the result never
/// varies. Throws core::InputError at bar.place where a bar names an unknown steel, has no length or leaves
/// the concrete.
Embedding embed_bars(mesh::Mesh const& mesh, mesh::Adjacency const& adjacency,
                     std::span<model::BarSpec const> bars, std::span<model::SteelSpec const> steels,
                     std::span<int const> joint_of_shared_face);

/// Adds the steel's mass [kg] to corner c of tet t at mass[4 t + c]: rho_s A_s l, half at each end, by the
/// barycentric weights there (negative ones taken as zero).
void add_steel_mass(model::Bars const& bars, std::span<double> mass);

/// The tets that hold bars, ascending: each needs a slot in the overlay.
std::vector<int> host_tets(model::Bars const& bars);

} // namespace fissura::rebar
