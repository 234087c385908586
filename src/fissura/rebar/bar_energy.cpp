#include <algorithm>

#include "fissura/rebar/element_energy.hpp"
#include "fissura/rebar/rebar.hpp"

namespace fissura::rebar {

namespace {

/// The share of an element's own stiffness that is left: an end at an activated joint has handed its half
/// over.
double share_left(model::Bars const& bars, state::BarState const& s, model::BarElement const& e) {
  if (bars.settings.between_cracks == model::BarBetweenCracks::elastic) return 1;
  double share = 1;
  for (int joint : {e.joint0, e.joint1})
    if (joint >= 0 && s.is_activated(static_cast<std::size_t>(joint))) share -= 0.5;
  return share;
}

} // namespace

BarEnergy bar_energy(model::Bars const& bars, state::BarState const& s) {
  BarEnergy sum;
  for (std::size_t i = 0; i < bars.elements.size(); ++i)
    if (double const share = share_left(bars, s, bars.elements[i]); share > 0)
      sum.elements += share * elastic_energy(bars, s, static_cast<int>(i));
  for (std::size_t i = 0; i < bars.joints.size(); ++i) {
    auto const& law = bars.joint_law[i];
    sum.joints += s.is_activated(i) ? laws::bar_joint_stored(law.activated, s.history[i])
                                    : intact_energy(law, s.motion[i].axial);
    // A joint books the work it takes less what it holds, so its own balance closes whatever its laws do.
    // What it has given back beyond that came from nowhere: it is no loss, and stays missing in the balance.
    sum.bond_steel += std::max(0.0, s.account[i].bond_steel);
    sum.dowel += s.account[i].dowel;
    sum.rupture += s.account[i].rupture;
  }
  return sum;
}

} // namespace fissura::rebar
