#pragma once
// What frames tell of a joint, the same in the list of cracks and on the surface of the body.
#include <vector>

#include "fissura/model/model.hpp"
#include "fissura/output/grid.hpp"
#include "fissura/state/state.hpp"

namespace fissura::sim {

/// Fields of cells that belong to joints, cell by cell.
class JointFields {
 public:
  void add(model::Model const& m, state::State const& s, int joint);
  /// A face that is no joint: zeros.
  void add_none();
  std::vector<output::Array> arrays() const;

 private:
  std::vector<float> opening_, sliding_, damage_, failed_, lost_I_, lost_II_;
  std::vector<std::int32_t> mode_, broken_;
};

/// Whether all three points of a joint have passed their strength: what the counts call cracked.
bool is_cracked(state::State const& s, int joint);

} // namespace fissura::sim
