#pragma once
// From a case to the immutable problem.
#include <functional>
#include <string>
#include <vector>

#include "fissura/mesh/quality.hpp"
#include "fissura/model/model.hpp"
#include "fissura/rebar/embed.hpp"

namespace fissura::sim {

/// What building found out, for the log and the forecast.
struct BuildReport {
  mesh::Quality quality;
  rebar::EmbeddingReport embedding;
  std::vector<std::string> notes;    ///< assumed values and derived strengths
  std::vector<std::string> warnings; ///< each with its cure
};

/// Reads or makes the mesh, checks and renumbers it, makes joints, bars and loads, and chooses the time step.
/// Throws core::InputError naming the place in the deck or in the mesh. `between` is called now and then;
/// what it throws ends the building.
model::Model build_model(model::Case const& c, BuildReport& report,
                         std::function<void()> const& between = {});

/// Supports, motions, forces, tractions, gravity and stages of the case, resolved to nodes; fills in
/// overlay_tets.
void build_loads(model::Model& m, BuildReport& report);
/// Resolves planes, impactors and initial velocities.
void build_rigid(model::Model& m);

/// Dashpots of the absorbing boundaries; after all else, since they need the supports and the final masses.
void build_absorbing(model::Model& m);

} // namespace fissura::sim
