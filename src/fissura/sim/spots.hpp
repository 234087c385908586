#pragma once
// From a number in the model or the state to a place that a user can look at.
#include <optional>

#include "fissura/model/model.hpp"
#include "fissura/sim/trouble.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

Spot tet_spot(model::Model const& m, int tet, std::string field = {});
Spot joint_spot(model::Model const& m, int joint, std::string field = {});
Spot bar_element_spot(model::Model const& m, std::size_t element, std::string field = {});
Spot bar_joint_spot(model::Model const& m, std::size_t joint, std::string field = {});

/// The tet with the fastest node, and how fast that is [m/s].
struct Fastest {
  int tet = -1;
  double speed = 0;
};
Fastest fastest_tet(model::Model const& m, state::State const& s);

/// Where displacements or velocities are not finite: of all such tets the one that has the most such numbers,
/// of equals the one whose neighbours have, and then the one nearest to the middle of them all: there it
/// began.
std::optional<Spot> find_non_finite_motion(model::Model const& m, state::State const& s);
/// The first number outside of the nodes that is not finite: histories, accounts, bars, contact, rigid
/// bodies, loads. Histories of joints that were never damaged are not in use and are not looked at.
std::optional<Spot> find_non_finite_memory(model::Model const& m, state::State const& s);
/// The same answer, without the place, as fast as can be.
bool memory_is_finite(model::Model const& m, state::State const& s);
/// The same, of the joints that act only the memory of their points: an account or separation of theirs that
/// is not finite spoils their forces or is computed anew.
bool idle_memory_is_finite(model::Model const& m, state::State const& s);

} // namespace fissura::sim
