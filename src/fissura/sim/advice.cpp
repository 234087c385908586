#include "fissura/sim/advice.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <set>

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

} // namespace

std::vector<std::string> advice(Model const& m, mesh::Quality const& quality) {
  std::vector<std::string> out;
  if (!m.source.concretes.empty()) advise_height(out, m, quality);
  return out;
}

} // namespace fissura::sim
