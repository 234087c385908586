#pragma once
// Fragments: the connected bodies of tets that fracture has left. Two tets belong to one body if a bonded
// face or a joint that is not broken lies between them. Bars do not join bodies, and neither does contact: a
// body that hangs on a bar is a fragment and says so (`held_by_bars`).
#include <vector>

#include "fissura/model/model.hpp"
#include "fissura/output/json_fwd.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

struct Fragment {
  int tets = 0;
  int first_id = 0;          ///< smallest input number of its tets
  double mass = 0;           ///< concrete and its share of the steel, without mass scaling [kg]
  Vec3 centroid;             ///< of that mass, where it is now [m]
  Vec3 velocity;             ///< momentum over mass, both as the step moves them: with mass scaling [m/s]
  double kinetic_energy = 0; ///< of translation, rotation and vibration, with mass scaling [J]
  bool held_by_bars = false; ///< an unbroken bar runs to another fragment
};

struct Fragments {
  std::vector<int> of_tet;      ///< number of the fragment of each tet
  std::vector<Fragment> bodies; ///< by falling mass; equal masses by `first_id`

  /// Sum of the masses [kg]: that of the model.
  double mass() const;
};

/// The fragments now. Displacements at step n, velocities at n - 1/2.
Fragments find_fragments(model::Model const& m, state::State const& s);

/// How many there are; counts anew only when more joints have broken.
class FragmentCount {
 public:
  /// `broken`: number of broken joints, released ones included.
  int operator()(model::Model const& m, state::State const& s, int broken);

 private:
  int counted_at_ = -1, count_ = 0;
};

/// The entry `fragments` of run.json: count, mass, and the 20 largest bodies.
output::Json fragments_json(Fragments const& fragments);

} // namespace fissura::sim
