#include "fissura/checkpoint/validate.hpp"

#include <algorithm>
#include <bitset>
#include <cstdlib>
#include <tuple>

#include "fissura/core/finite.hpp"

namespace fissura::checkpoint {

namespace {

bool is_tet(model::Model const& m, int tet) {
  return tet >= 0 && tet < m.tet_count();
}

bool statuses_fit(state::State const& s) {
  return std::all_of(s.joint_status.begin(), s.joint_status.end(),
                     [](auto x) { return x <= static_cast<std::uint8_t>(state::JointStatus::released); });
}

/// Each damaged joint has a lane of its own: the first ones of its group, released joints the last ones.
bool lanes_fit(state::State const& s) {
  auto const& h = s.joint_history;
  for (std::size_t g = 0; g < h.groups(); ++g) {
    auto const n = state::count_lanes(s, g);
    std::size_t const first = h.first_of(g), room = h.room(g);
    std::bitset<state::JointHistories::group> taken;
    for (std::size_t j = first; j < first + room; ++j) {
      auto const status = state::status_of(s, static_cast<int>(j));
      if (status == state::JointStatus::intact) continue;
      std::size_t const lane = h.lane[j];
      bool const fits = status == state::JointStatus::released
                            ? lane < room && lane + static_cast<std::size_t>(n.released) >= room
                            : lane < static_cast<std::size_t>(n.at_work);
      if (!fits || taken[lane]) return false;
      taken[lane] = true;
    }
  }
  return true;
}

bool pairs_fit(model::Model const& m, std::vector<state::ContactPair> const& pairs) {
  auto const fits = [&](auto const& p) { return is_tet(m, p.a) && is_tet(m, p.b) && p.a < p.b; };
  auto const before = [](auto const& x, auto const& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); };
  return std::all_of(pairs.begin(), pairs.end(), fits) && std::is_sorted(pairs.begin(), pairs.end(), before);
}

bool touches_fit(model::Model const& m, std::vector<state::RigidTouch> const& touch) {
  constexpr int faces = 4, points = std::tuple_size_v<decltype(state::RigidScratch::Result::touch)>;
  auto const fits = [&](auto const& t) {
    return is_tet(m, t.tet) && t.face < faces && t.point < points && t.body < m.rigid.size();
  };
  auto const before = [](auto const& x, auto const& y) {
    return std::tie(x.tet, x.face, x.body, x.point) < std::tie(y.tet, y.face, y.body, y.point);
  };
  return std::all_of(touch.begin(), touch.end(), fits) && std::is_sorted(touch.begin(), touch.end(), before);
}

/// The branches that a bar remembers are as many as there is room for, or fewer.
bool bars_fit(state::BarState const& bars) {
  auto const fits = [](laws::BranchList const& list) {
    return list.count >= 0 && list.count <= laws::BranchList::capacity;
  };
  return std::all_of(bars.history.begin(), bars.history.end(), [&](auto const& h) {
    return fits(h.steel.rising) && fits(h.steel.falling) && std::abs(h.steel.direction) <= 1;
  });
}

bool paths_fit(model::Model const& m, std::vector<state::PathState> const& paths) {
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (paths[i].target < -1 || paths[i].target > static_cast<int>(m.paths[i].targets.size())) return false;
  return true;
}

} // namespace

void validate(model::Model const& m, state::State const& s, Loader const& from) {
  if (s.step < 0 || !core::is_finite(s.time)) from.refuse("the time is no time");
  if (s.stage < 0 || s.stage >= static_cast<int>(m.stages.size())) from.refuse("there is no such stage");
  if (!statuses_fit(s)) from.refuse("a joint has an unknown status");
  if (!lanes_fit(s)) from.refuse("histories of joints do not fit their status");
  if (!pairs_fit(m, s.contact.pairs)) from.refuse("pairs of tets in contact do not fit the mesh");
  if (!touches_fit(m, s.rigid.touch)) from.refuse("points in touch with rigid bodies do not fit the mesh");
  if (!bars_fit(s.bars)) from.refuse("a bar remembers more branches than there is room for");
  if (!paths_fit(m, s.paths)) from.refuse("a path has no such target");
}

} // namespace fissura::checkpoint
