#pragma once
// Frames for ParaView: what a run looks like at one time.
#include <array>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "fissura/model/model.hpp"
#include "fissura/output/grid.hpp"
#include "fissura/output/pvd.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

/// All tets: displacement, velocity at the nodes; stress, group, input number, fragment per tet.
output::Grid tet_grid(model::Model const& m, state::State const& s);
/// Damaged joints as triangles: opening, sliding, damage, mode, time of failure, dissipated energy.
output::Grid crack_grid(model::Model const& m, state::State const& s);
/// The same as a frame has it: where no joint is damaged the first one of the model stands in, undamaged,
/// since some readers (meshio) cannot open a file without cells.
output::Grid crack_frame(model::Model const& m, state::State const& s);
/// Bar elements as lines (stress) and bar joints as vertices (slip, strain, stress), for Python.
output::Grid bar_grid(model::Model const& m, state::State const& s);
/// Bars as polylines, as frames have them: one per bar, two where it has ruptured or leaves the concrete for
/// a while. Points are the ends of bar elements, two to each, in the order of the elements; fields at points.
output::Grid bar_lines(model::Model const& m, state::State const& s);
/// The outer faces of the body and both faces of every cracked joint, as triangles: opening, damage, ...
output::Grid surface_grid(model::Model const& m, state::State const& s);
/// Surfaces of planes (a patch) and impactors as triangles: displacement, velocity; which body.
output::Grid rigid_grid(model::Model const& m, state::State const& s);

/// A frame that has been written; its number is its place in the list.
struct Frame {
  double time; ///< [s]
  using ListGrows = void;
  static auto fields(auto& self) { return std::tie(self.time); }
};

/// What a run draws, each with a list of its frames, <name>.pvd.
inline constexpr std::array<std::string_view, 5> collections{"fields", "cracks", "bars", "surface", "rigid"};

/// The file of a frame, seen from the run folder.
std::string frame_file(std::string_view collection, std::size_t number);

/// The collections of a run folder, each where it has something to show.
class FieldWriter {
 public:
  explicit FieldWriter(std::string const& folder);
  /// Writes one frame of each collection.
  void write(model::Model const& m, state::State const& s);
  std::vector<Frame> const& frames() const { return frames_; }
  /// Goes on after the frames that were there at a checkpoint: the lists name them and no others.
  void start_with(model::Model const& m, std::vector<Frame> const& frames);

 private:
  std::string folder_;
  std::vector<output::PvdWriter> lists_; ///< one per collection
  std::vector<Frame> frames_;
};

} // namespace fissura::sim
