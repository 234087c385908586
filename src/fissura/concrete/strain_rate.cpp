#include "fissura/concrete/strain_rate.hpp"

#include <cmath>

#include "fissura/concrete/concrete.hpp"
#include "fissura/laws/rate_factor.hpp"

namespace fissura::concrete {

using model::Model;
using state::State;

namespace {

/// The average looks back over this many times h over the speed of sound: noise of the mesh has about pi of
/// them as its period.
constexpr double memory = 10;

Vec3 sample(Model const& m, State const& s, int tet, Vec3 n) {
  Mat3 const L = gradient_in(m, s.v, tet);
  return 0.5 * (L * n + transpose(L) * n);
}

/// Share that a sample keeps from one step to the next.
double decay(Model const& m, int joint, int tet) {
  auto const t = static_cast<std::size_t>(tet);
  auto const& c = m.source.concretes[m.material_of_tet[t]];
  double const speed =
      std::sqrt((2 * m.tets.shear_modulus(t) + m.tets.lame(t)) / (c.density * c.density_factor));
  return std::exp(-m.dt * speed / (memory * m.joints.joints[joint].h));
}

} // namespace

void follow_strain_rate(Model const& m, State& s, int joint, Vec3 normal) {
  if (s.joint_rate.size() == 0 || !m.joints.law(joint).straight_tension) return;
  auto& r = s.joint_rate[joint];
  if (r.frozen) return;
  auto const& face = m.adjacency.shared[m.joints.joints[joint].shared_face];
  Vec3 const now = 0.5 * (sample(m, s, face.a.tet, normal) + sample(m, s, face.b.tet, normal));
  // A joint that was quiet in between starts anew: old samples say nothing.
  double const keep = r.last_step + 1 == s.step ? decay(m, joint, face.a.tet) : 0;
  for (int i = 0; i < 3; ++i) r.sum[i] = keep * r.sum[i] + now[i];
  r.weight = keep * r.weight + 1;
  r.last_step = s.step;
  r.excess = laws::rate_factor_mc2010(norm(Vec3{r.sum[0], r.sum[1], r.sum[2]}) / r.weight) - 1;
}

} // namespace fissura::concrete
