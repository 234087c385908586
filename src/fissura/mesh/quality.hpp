#pragma once
// How good a sound mesh is: numbers for the start of the log, and warnings.
#include <array>
#include <string>
#include <vector>

#include "fissura/mesh/mesh.hpp"

namespace fissura::mesh {

/// Smallest dihedral angle [rad] (10 degrees) and smallest altitude / longest edge below which a tet is a
/// sliver.
inline constexpr double sliver_angle = 0.17453292519943295;
inline constexpr double sliver_ratio = 0.05;

/// A tet that stands out: its index, its number in the input and its centroid [m].
struct NamedTet {
  int tet = -1, input_id = -1;
  Vec3 centroid;
};

struct Quality {
  long tets = 0;
  double volume = 0, mean_volume = 0, min_volume = 0, max_volume = 0; ///< [m3]
  double mean_h = 0, min_h = 0,
         max_h = 0;             ///< h = (6 sqrt(2) V)^(1/3) of the mean, least and largest volume [m]
  double smallest_altitude = 0; ///< [m]; it limits the stable step
  NamedTet smallest_altitude_tet;
  double smallest_angle = 0; ///< smallest dihedral angle [rad]
  NamedTet smallest_angle_tet;
  long slivers = 0;
  Vec3 low, high; ///< corners of the box around the tets [m]
  std::array<double, 3>
      elements_over{};      ///< extent along x, y, z / mean extent of a tet along it: cells of a box mesh
  long open_interfaces = 0; ///< pairs of boundary faces that coincide but share no points: no joint there
  Vec3 open_interface_at;   ///< the first of them [m]
};

/// The mesh must have passed check_mesh.
Quality measure_quality(Mesh const& mesh, Adjacency const& adjacency);

/// What a user should be told: slivers, an altitude far below the mean element size (it limits the step),
/// fewer than four elements over an extent, interfaces left open. Empty for a good mesh.
std::vector<std::string> quality_warnings(Quality const& quality);

} // namespace fissura::mesh
