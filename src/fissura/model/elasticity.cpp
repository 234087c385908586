#include "fissura/model/elasticity.hpp"

#include <algorithm>
#include <cmath>

namespace fissura::model {

namespace {

/// Flat tets have much more joint than volume. Compensated in full they would be stiffer than anything, or
/// hardly compressible: the share c E stays below this, and the others take over what is cut.
double largest_share(ConcreteSpec const& c) {
  constexpr double largest_nu = 0.4;
  return std::min(0.4, c.nu > 0 ? 1 - c.nu / largest_nu : 0.4);
}

/// Equal tets get equal constants, to the bit, so that blocks share them (SharedRows).
double rounded(double share) {
  constexpr double steps = 1 << 24;
  return std::round(share * steps) / steps;
}

} // namespace

Elastic compensated(ConcreteSpec const& concrete, double c) {
  double const stiffer = 1 / (1 - c * concrete.E);
  return {stiffer * concrete.E, stiffer * concrete.nu};
}

std::vector<double> joint_compliance(Model const& m) {
  std::vector<double> c(static_cast<std::size_t>(m.tets.count), 0);
  auto const spec = [&](std::size_t tet) -> ConcreteSpec const& {
    return m.source.concretes[static_cast<std::size_t>(m.material_of_tet[tet])];
  };
  for (std::size_t j = 0; j < static_cast<std::size_t>(m.joints.count); ++j) {
    auto const& face = m.adjacency.shared[static_cast<std::size_t>(m.joints.joints[j].shared_face)];
    for (int const side : {face.a.tet, face.b.tet})
      c[static_cast<std::size_t>(side)] +=
          m.joints.joints[j].area / (6 * m.joints.k(j) * m.tets.volume[side]);
  }
  for (std::size_t k = 0; k < m.source.concretes.size(); ++k) {
    ConcreteSpec const& concrete = m.source.concretes[k];
    double const most = largest_share(concrete) / concrete.E;
    double whole = 0, cut = 0;
    for (std::size_t t = 0; t < c.size(); ++t)
      if (&spec(t) == &concrete)
        whole += m.tets.volume[t] * c[t], cut += m.tets.volume[t] * std::min(c[t], most);
    for (std::size_t t = 0; t < c.size(); ++t) {
      if (&spec(t) != &concrete) continue;
      double const share = cut > 0 ? std::min(most, std::min(c[t], most) * whole / cut) * concrete.E : 0;
      c[t] = concrete.elastic == Elasticity::compensated ? rounded(share) / concrete.E : 0;
    }
  }
  return c;
}

} // namespace fissura::model
