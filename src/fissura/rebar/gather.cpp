#include <algorithm>

#include "fissura/parallel/parallel.hpp"
#include "fissura/rebar/lanes.hpp"
#include "fissura/rebar/rebar.hpp"

#include <fmt/core.h>

namespace fissura::rebar {

namespace {

using Entry = state::BarScratch::Entry;

/// Who acts on which host tet: bar elements in order, then bar joints in order, sides a before b.
std::vector<std::pair<int, Entry>> entries_of(model::Bars const& bars) {
  std::vector<std::pair<int, Entry>> all;
  for (int i = 0; i < static_cast<int>(bars.elements.size()); ++i)
    all.push_back({bars.elements[i].tet, {Entry::Kind::element, i}});
  for (int i = 0; i < static_cast<int>(bars.joints.size()); ++i) {
    all.push_back({bars.joints[i].tet_a, {Entry::Kind::side_a, i}});
    all.push_back({bars.joints[i].tet_b, {Entry::Kind::side_b, i}});
  }
  std::stable_sort(all.begin(), all.end(), [](auto const& x, auto const& y) { return x.first < y.first; });
  return all;
}

void add(double* corner, double weight, Vec3 f) {
  corner[0] += weight * f.x;
  corner[1] += weight * f.y;
  corner[2] += weight * f.z;
}

/// The hosts [begin, end).
void gather(model::Model const& m, state::Scratch& w, std::size_t begin, std::size_t end) {
  for (std::size_t h = begin; h < end; ++h) {
    auto const& host = w.bars.hosts[h];
    double* const out = w.overlay.at(host.slot);
    for (int i = host.begin; i < host.end; ++i) {
      auto const entry = w.bars.entries[i];
      if (entry.kind == Entry::Kind::element) {
        auto const& e = m.bars.elements[entry.index];
        for (int c = 0; c < 4; ++c)
          add(out + core::per_node * c, e.w0[c] - e.w1[c], w.bars.element[entry.index].force);
      } else {
        auto const& j = w.bars.joint[entry.index];
        bool const a = entry.kind == Entry::Kind::side_a;
        for (int c = 0; c < 4; ++c) add(out + core::per_node * c, a ? j.w_a[c] : -j.w_b[c], j.force);
      }
    }
  }
}

} // namespace

state::BarScratch make_bar_scratch(model::Model const& m, state::Overlay const& overlay) {
  if (m.bars.joint_law.size() != m.bars.joints.size())
    throw core::Error(core::Failure::run, "bar joints have no laws yet: set_bar_joint_laws comes first");
  state::BarScratch w;
  w.element.resize(m.bars.elements.size());
  w.joint.resize(m.bars.joints.size());
  make_bar_lanes(m, w);
  for (auto const& [tet, entry] : entries_of(m.bars)) {
    if (w.hosts.empty() || w.hosts.back().tet != tet) {
      int const slot = overlay.slot_of_tet[tet];
      if (slot < 0)
        throw core::Error(core::Failure::run, fmt::format("tet {} holds a bar but no overlay slot", tet));
      w.hosts.push_back({tet, slot, static_cast<int>(w.entries.size()), 0});
    }
    w.entries.push_back(entry);
    w.hosts.back().end = static_cast<int>(w.entries.size());
  }
  return w;
}

void gather_bar_forces(model::Model const& m, state::Scratch& w) {
  parallel::for_chunks(w.bars.hosts.size(), 64,
                       [&](std::size_t, std::size_t begin, std::size_t end) { gather(m, w, begin, end); });
}

} // namespace fissura::rebar
