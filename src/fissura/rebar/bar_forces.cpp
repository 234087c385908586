#include "fissura/parallel/parallel.hpp"
#include "fissura/rebar/kernels.hpp"
#include "fissura/rebar/rebar.hpp"

namespace fissura::rebar {

BarPass bar_pass(model::Model const& m, state::State& s, state::Scratch& w) {
  return {&m.bars, m.position.data(), s.u.data(), s.bars.elongation.data(), &w.bars};
}

void activate_all(model::Model const& m, state::BarState& s) {
  for (std::size_t i = 0; i < m.bars.joints.size(); ++i)
    if (m.bars.joint_law[i].crackable)
      laws::activate(m.bars.joint_law[i].activated, s.history[i], 0, {}, 0, 0);
}

state::BarState make_bar_state(model::Bars const& bars) {
  state::BarState s;
  std::size_t const elements = bars.elements.size(), joints = bars.joints.size();
  s.elongation.assign(elements, 0);
  s.element_stress.assign(elements, 0);
  s.history.resize(joints);
  s.motion.resize(joints);
  s.account.resize(joints);
  for (auto* field : {&s.joint_stress, &s.joint_strain, &s.slip, &s.normalised_slip, &s.dowel_force})
    field->assign(joints, 0);
  return s;
}

namespace {

void element_forces(model::Model const& m, state::State& s, state::Scratch& w, std::size_t begin,
                    std::size_t end) {
  bool const slip_only = m.bars.settings.between_cracks == model::BarBetweenCracks::slip_only;
  for (std::size_t i = begin; i < end; ++i) {
    auto const& e = m.bars.elements[i];
    auto const& bar = m.bars.properties[e.bar];
    double const own =
        bar.steel.E_s * bar.area * (s.bars.elongation[i] / e.length + bar.initial_strain); // Eqs. 4, 5
    auto const end_force = [&](int joint) {
      bool const cracked = slip_only && joint >= 0 && s.bars.is_activated(static_cast<std::size_t>(joint));
      return cracked ? w.bars.joint[static_cast<std::size_t>(joint)].pull : own;
    };
    double const force = 0.5 * (end_force(e.joint0) + end_force(e.joint1));
    s.bars.element_stress[i] = force / bar.area;
    w.bars.element[i].force = force * Vec3(w.bars.element[i].direction);
  }
}

} // namespace

void bar_forces(model::Model const& m, state::State& s, state::Scratch& w) {
  parallel::for_chunks(m.bars.elements.size(), 128, [&](std::size_t, std::size_t begin, std::size_t end) {
    element_forces(m, s, w, begin, end);
  });
}

} // namespace fissura::rebar
