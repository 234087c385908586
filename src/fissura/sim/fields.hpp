#pragma once
// Frames for ParaView: what a run looks like at one time.
#include <string>

#include "fissura/model/model.hpp"
#include "fissura/output/pvd.hpp"
#include "fissura/output/vtu.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

/// All tets: displacement, velocity at the nodes; stress, group, input number, fragment per tet.
output::Grid tet_grid(model::Model const& m, state::State const& s);
/// Damaged joints as triangles: opening, sliding, damage, mode, time of failure, dissipated energy.
output::Grid crack_grid(model::Model const& m, state::State const& s);
/// Bar elements as lines (stress) and bar joints as vertices (slip, strain, stress).
output::Grid bar_grid(model::Model const& m, state::State const& s);
/// Surfaces of planes (a patch) and impactors as triangles: displacement, velocity; which body.
output::Grid rigid_grid(model::Model const& m, state::State const& s);

/// The collections of a run folder; that of the rigid bodies only where there are some.
class FieldWriter {
 public:
  explicit FieldWriter(std::string const& folder);
  /// Writes one frame of each collection.
  void write(model::Model const& m, state::State const& s);
  int frames() const { return frame_; }

 private:
  void add(output::PvdWriter& list, char const* name, double time, output::Grid const& grid);
  std::string folder_;
  output::PvdWriter fields_, cracks_, bars_, rigid_;
  int frame_ = 0;
};

} // namespace fissura::sim
