#include <algorithm>

#include <fmt/core.h>

#include "fissura/rebar/activation.hpp"
#include "fissura/rebar/rebar.hpp"

namespace fissura::rebar {

namespace {

laws::SteelParams steel_params(model::SteelSpec const& s) {
  laws::SteelParams p;
  p.E_s = s.E_s, p.f_y = s.f_y, p.f_u = s.f_u;
  p.eps_sh = s.eps_sh, p.eps_u = s.eps_u, p.eps_br = s.eps_br;
  p.law = s.law == model::SteelLaw::kato ? laws::SteelLaw::kato : laws::SteelLaw::menegotto_pinto;
  return p;
}

/// The faces C of a bar joint as one: compliances along the bar add up, the weakest face governs.
struct Series {
  double compliance = 0; ///< d.r over the traction along the bar [m/Pa]
  double f_t = 0;        ///< of the weakest crackable face [Pa]
  bool crackable = false;
  bool straight = true; ///< up to the strength of all that can crack
};

Series faces_in_series(model::Model const& m, model::BarJoint const& j) {
  Series s;
  double largest = 0;
  for (int f = j.faces_begin; f < j.faces_end; ++f) {
    auto const& face = m.bars.faces[f];
    auto const law = m.joints.law(face.joint);
    s.compliance += face.cosine / law.k;
    largest = std::max(largest, 1 / law.k);
    if (!law.crackable) continue;
    s.straight = s.straight && law.straight_tension;
    s.f_t = s.crackable ? std::min(s.f_t, law.f_t) : law.f_t;
    s.crackable = true;
  }
  s.compliance = std::max(s.compliance, 0.1 * largest); // a bar nearly in the plane of a face
  return s;
}

/// Where two concretes meet: the stiffness of both in series, the strength of the weaker that has one.
struct Concrete {
  double E, f_c;
};
Concrete concrete_at(model::Model const& m, model::BarJoint const& j) {
  auto const& a = m.source.concretes[m.material_of_tet[j.tet_a]];
  auto const& b = m.source.concretes[m.material_of_tet[j.tet_b]];
  double const f_c = a.f_c > 0 && b.f_c > 0 ? std::min(a.f_c, b.f_c) : std::max(a.f_c, b.f_c);
  return {2 * a.E * b.E / (a.E + b.E), f_c};
}

model::BarJointLaw law_of(model::Model const& m, model::BarJoint const& j) {
  auto const& bar = m.bars.properties[j.bar];
  auto const concrete = concrete_at(m, j);
  auto const series = faces_in_series(m, j);
  model::BarJointLaw law;
  law.crackable = series.crackable;
  law.prestress = bar.steel.E_s * bar.initial_strain;
  law.intact = laws::uncracked_bar_joint(bar.steel.E_s / concrete.E, 1, series.compliance, series.f_t,
                                         bar.area, series.crackable && !series.straight);
  if (law.crackable) {
    laws::BarJointInput in;
    in.D = bar.diameter, in.A_s = bar.area, in.steel = steel_params(bar.steel), in.f_c = concrete.f_c;
    in.dowel = m.bars.settings.dowel;
    if (bar.slip_reduction == model::SlipReduction::paper) {
      in.l_cr = crack_length(bar, j);
    } else {
      in.l_g = length_of_face(j), in.l_b = 0.5 * bar.crack_spacing[static_cast<std::size_t>(j.copy)];
    }
    law.activated = laws::make_bar_joint_params(in);
  }
  return law;
}

} // namespace

void set_bar_joint_laws(model::Model& m) {
  m.bars.settings = m.source.bar_settings;
  m.bars.joint_law.clear();
  for (auto& face : m.bars.faces) face.surely_intact = surely_intact_jump(m.joints.law(face.joint));
  m.bars.joint_law.reserve(m.bars.joints.size());
  for (auto const& j : m.bars.joints) {
    try {
      m.bars.joint_law.push_back(law_of(m, j));
    } catch (core::Error const& error) {
      throw core::InputError(m.source.bars[j.bar].place,
                             fmt::format("bar '{}': {}", m.bars.properties[j.bar].name, error.what()));
    }
  }
}

} // namespace fissura::rebar
