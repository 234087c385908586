#pragma once
// Which copies belong to one point.
#include "fissura/model/model.hpp"

namespace fissura::model {

/// Fills in Model::points, without rate and own inertia, from adjacency, joints, bonding and prescribed.
void make_points(Model& m);

} // namespace fissura::model
