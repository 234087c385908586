#pragma once
// Frames for ParaView: what a run looks like at one time.
#include <string>
#include <tuple>
#include <vector>

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

/// A frame that has been written; its number is its place in the list.
struct Frame {
  double time; ///< [s]
  using ListGrows = void;
  static auto fields(auto& self) { return std::tie(self.time); }
};

/// The file of a frame, seen from the run folder. Collections: fields, cracks, bars, rigid.
std::string frame_file(char const* collection, std::size_t number);

/// The collections of a run folder; that of the rigid bodies only where there are some.
class FieldWriter {
 public:
  explicit FieldWriter(std::string const& folder);
  /// Writes one frame of each collection.
  void write(model::Model const& m, state::State const& s);
  std::vector<Frame> const& frames() const { return frames_; }
  /// Goes on after the frames that were there at a checkpoint: the lists name them and no others.
  void start_with(model::Model const& m, std::vector<Frame> const& frames);

 private:
  void add(output::PvdWriter& list, char const* name, double time, output::Grid const& grid);
  std::string folder_;
  output::PvdWriter fields_, cracks_, bars_, rigid_;
  std::vector<Frame> frames_;
};

} // namespace fissura::sim
