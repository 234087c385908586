#include "fissura/sim/advice.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <set>

#include "fissura/model/select.hpp"

namespace fissura::sim {

using model::Model;

namespace {

constexpr double slender = 3; ///< length over height of what is taken for a beam
constexpr double cells_wanted = 8;

/// Axes along which something pushes or pulls.
std::set<int> loaded_axes(model::Case const& c) {
  std::set<int> axes;
  auto const add = [&](Vec3 direction) {
    for (int k = 0; k < 3; ++k)
      if (std::abs(direction[k]) > 0.5) axes.insert(k);
  };
  for (auto const& motion : c.motions) axes.insert(motion.axis);
  for (auto const& force : c.forces) add(force.direction);
  for (auto const& traction : c.tractions)
    if (!traction.normal) add(traction.direction);
  if (c.gravity.on) add(c.gravity.direction);
  return axes;
}

void advise_height(std::vector<std::string>& out, Model const& m, mesh::Quality const& q) {
  Vec3 const extent = q.high - q.low;
  double const length = std::max({extent.x, extent.y, extent.z});
  if (m.source.supports.empty()) return;
  for (int const k : loaded_axes(m.source)) {
    auto const cells = q.elements_over[static_cast<std::size_t>(k)];
    if (length < slender * extent[k] || cells >= cells_wanted - 0.5 || cells < 3.5)
      continue; // below: said by the mesh
    out.push_back(fmt::format(
        "about {:.1f} elements over the height along {} ({:.4g} m) of a member that is bent: with {:.0f} "
        "or more its stiffness and crack pattern hardly change any more; use a finer mesh",
        cells, "xyz"[k], extent[k], cells_wanted));
  }
}

/// Where the points of a support lie.
struct Patch {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  double extent(int axis) const { return high[axis] - low[axis]; }
};

Patch patch_of(Model const& m, model::Selector const& where) {
  Patch patch;
  for (int const point : model::select_points(m.mesh, where))
    for (int k = 0; k < 3; ++k) {
      double const x = m.mesh.points[static_cast<std::size_t>(point)][k];
      patch.low[k] = std::min(patch.low[k], x), patch.high[k] = std::max(patch.high[k], x);
    }
  return patch;
}

/// A bearing that holds a patch of a bent member across its span keeps it from turning there, like a wall. An
/// end face has no length along the span and is meant to; so is a block held over the whole height, and a
/// body that lies on its support for most of its length is not bent by it.
void advise_bearings(std::vector<std::string>& out, Model const& m, mesh::Quality const& q) {
  Vec3 const extent = q.high - q.low;
  int along = 0;
  for (int k = 1; k < 3; ++k)
    if (extent[k] > extent[along]) along = k;
  for (auto const& s : m.source.supports)
    for (int const k : loaded_axes(m.source)) {
      if (k == along || !s.fix[static_cast<std::size_t>(k)] || extent[along] < slender * extent[k]) continue;
      auto const patch = patch_of(m, s.where);
      bool const has_length = patch.extent(along) > 1e-6 * extent[along];
      if (!has_length || patch.extent(along) > 0.5 * extent[along] || patch.extent(k) > 0.5 * extent[k])
        continue;
      out.push_back(
          fmt::format("support `{0}` holds {1} over a length of {2:.3g} mm along {3}: that keeps the member "
                      "from turning there, "
                      "as a wall would, and it carries more than on a bearing; hold one line of points "
                      "across it (where = "
                      "{{line = [...]}}, or {{plane = \"{3}\", ...}} through the middle of a bearing plate)",
                      s.name, "xyz"[k], 1e3 * patch.extent(along), "xyz"[along]));
    }
}

} // namespace

std::vector<std::string> advice(Model const& m, mesh::Quality const& quality) {
  std::vector<std::string> out;
  if (!m.source.concretes.empty()) advise_height(out, m, quality), advise_bearings(out, m, quality);
  return out;
}

} // namespace fissura::sim
