#include "fissura/contact/contact.hpp"
#include "fissura/contact/pair_law.hpp"
#include "fissura/parallel/parallel.hpp"

namespace fissura::contact {

using model::Model;
using state::Scratch;
using state::State;

namespace {

constexpr std::size_t pairs_per_chunk = 64, hosts_per_chunk = 64;

struct PairSums {
  double stored = 0, lost = 0; ///< [J]
  PairSums& operator+=(PairSums const& b) {
    stored += b.stored, lost += b.lost;
    return *this;
  }
};

/// Corners seen from a point near the pair, so that small overlaps keep their digits.
struct Corners {
  std::array<Vec3, 4> reference, now;
};
Corners corners(Model const& m, State const& s, int tet, Vec3 origin) {
  Corners x;
  for (int c = 0; c < 4; ++c) {
    int const node = model::node_of(tet, c);
    x.reference[c] = m.position.at(node) - origin;
    x.now[c] = x.reference[c] + s.u.at(node);
  }
  return x;
}

std::array<Vec3, 4> last_step(Model const& m, State const& s, int tet) {
  std::array<Vec3, 4> step;
  for (int c = 0; c < 4; ++c) step[c] = m.dt * s.v.at(model::node_of(tet, c));
  return step;
}

PairSums evaluate(Model const& m, State& s, Scratch& w, std::size_t i) {
  auto& pair = s.contact.pairs[i];
  auto& force = w.contact.force[i];
  Vec3 const origin = m.position.at(model::node_of(pair.a, 0));
  Corners const a = corners(m, s, pair.a, origin), b = corners(m, s, pair.b, origin);
  bool const has_memory = pair.energy_at_start > 0 || pair.stiffness > 0;
  if (!has_memory && are_apart(a.now, b.now, w.contact.separator[i])) {
    pair.energy_at_start = 0;
    force.acts = false;
    return {};
  }
  PairNow const now{make_tet_now(a.now, a.reference), make_tet_now(b.now, b.reference),
                    last_step(m, s, pair.a), last_step(m, s, pair.b)};
  PairResult const r = pair_law(w.contact.constants[i], now, pair);
  force = r.force;
  return {r.stored, r.lost};
}

void gather(Scratch& w, std::size_t begin, std::size_t end) {
  for (std::size_t h = begin; h < end; ++h) {
    auto const& host = w.contact.hosts[h];
    double* const out = w.overlay.at(host.slot);
    for (int i = host.begin; i < host.end; ++i) {
      auto const& entry = w.contact.entries[i];
      auto const& f = w.contact.force[entry.pair];
      if (!f.acts) continue;
      for (int c = 0; c < 4; ++c) {
        Vec3 const on = entry.is_a ? f.on_a[c] : f.on_b[c];
        double* const corner = out + core::per_node * c;
        corner[0] += on.x, corner[1] += on.y, corner[2] += on.z;
      }
    }
  }
}

} // namespace

void pair_forces(Model const& m, State& s, Scratch& w) {
  auto& c = s.contact;
  if (c.pairs.empty()) {
    c.stored = 0;
    return;
  }
  auto const sums = parallel::sum_chunks<PairSums>(c.pairs.size(), pairs_per_chunk,
                                                   [&](std::size_t begin, std::size_t end) {
                                                     PairSums sum;
                                                     for (std::size_t i = begin; i < end; ++i)
                                                       sum += evaluate(m, s, w, i);
                                                     return sum;
                                                   });
  c.stored = sums.stored;
  s.ledger.contact_friction += sums.lost;
  parallel::for_chunks(w.contact.hosts.size(), hosts_per_chunk,
                       [&](std::size_t, std::size_t begin, std::size_t end) { gather(w, begin, end); });
}

} // namespace fissura::contact
