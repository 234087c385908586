// When and how pairs are looked for. The boxes of tets are enlarged by a skin; a list of pairs holds until
// some node may have moved through half of it, or until faces part.
#include <algorithm>
#include <cmath>
#include <limits>

#include "fissura/contact/broad_phase.hpp"
#include "fissura/contact/contact.hpp"
#include "fissura/contact/linkage.hpp"
#include "fissura/contact/tet_overlap.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/model/defaults.hpp"
#include "fissura/parallel/parallel.hpp"

namespace fissura::contact {

using model::Model;
using state::ContactPair;
using state::Scratch;
using state::State;

namespace {

constexpr long steps_between_looks = 4;
constexpr double skin_share = 0.1; ///< of the mean size of the surface tets
/// Of m_a m_b/((m_a + m_b) dt^2), which is what k_n A may be at most. Stability would allow 0.25; the energy
/// error of a collision goes with the stiffness (when faces touch between two steps), and even at 0.1 a
/// pressure of 10 MPa closes concrete by no more than 1e-4 of a tet.
constexpr double stability_share = 0.1;
constexpr double skin_used = 0.8; ///< the rest covers velocities that grow between two looks
constexpr std::size_t tets_per_chunk = 512;
constexpr double inf = std::numeric_limits<double>::infinity();

Vec3 place_of(Model const& m, State const& s, int node) {
  return m.position.at(node) + s.u.at(node);
}

/// The box around the velocities of nodes [m/s].
struct Velocities {
  Vec3 low{inf, inf, inf}, high{-inf, -inf, -inf};
  Velocities& operator+=(Velocities const& b) {
    for (int r = 0; r < 3; ++r) low[r] = std::min(low[r], b.low[r]), high[r] = std::max(high[r], b.high[r]);
    return *this;
  }
};

Velocities velocities_of(State const& s, std::vector<int> const& tets, std::size_t begin, std::size_t end) {
  Velocities of;
  for (std::size_t i = begin; i < end; ++i)
    for (int c = 0; c < 4; ++c) {
      Vec3 const v = s.v.at(model::node_of(tets[i], c));
      of += {v, v};
    }
  return of;
}

/// How far a surface node can go until the next look [m], seen from an observer who moves with the middle of
/// all velocities: half of what two nodes can approach each other.
double window_travel(Model const& m, State const& s, std::vector<int> const& tets) {
  if (tets.empty()) return 0;
  auto const of =
      parallel::sum_chunks<Velocities>(tets.size(), tets_per_chunk, [&](std::size_t begin, std::size_t end) {
        return velocities_of(s, tets, begin, end);
      });
  double const widest = norm(of.high - of.low);
  // Without any finite velocity the guards end the run after this step: nothing need be found any more.
  return std::isfinite(widest) ? 0.5 * static_cast<double>(steps_between_looks) * m.dt * widest : 0;
}

std::array<Vec3, 4> corners_of(Model const& m, State const& s, int tet) {
  std::array<Vec3, 4> x;
  for (int c = 0; c < 4; ++c) x[c] = place_of(m, s, model::node_of(tet, c));
  return x;
}

Box box_of(Model const& m, State const& s, int tet, double margin) {
  auto const corners = corners_of(m, s, tet);
  Box b{corners[0], corners[0]};
  for (Vec3 const x : corners)
    for (int r = 0; r < 3; ++r) b.low[r] = std::min(b.low[r], x[r]), b.high[r] = std::max(b.high[r], x[r]);
  for (int r = 0; r < 3; ++r) b.low[r] -= margin, b.high[r] += margin;
  return b;
}

/// Pairs of tets near each other and not linked, ascending.
std::vector<std::pair<int, int>> near_pairs(Model const& m, State const& s, Linkage const& link,
                                            std::vector<int> tets, double margin) {
  std::vector<Box> boxes;
  boxes.reserve(tets.size());
  for (int const t : tets) boxes.push_back(box_of(m, s, t, margin));
  auto pairs = meeting_boxes(boxes);
  for (auto& p : pairs) p = {tets[p.first], tets[p.second]};
  std::vector<char> is_far(pairs.size());
  parallel::for_chunks(pairs.size(), tets_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      auto const [a, b] = pairs[i];
      is_far[i] =
          are_linked(m, s, link, a, b) || gap_between(corners_of(m, s, a), corners_of(m, s, b)) > 2 * margin;
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!is_far[i]) pairs[kept++] = pairs[i];
  pairs.resize(kept);
  return pairs;
}

/// The new list with the memories of the old one; both are sorted.
void take_over(std::vector<ContactPair>& pairs, std::vector<std::pair<int, int>> const& now) {
  std::vector<ContactPair> next(now.size());
  auto old = pairs.begin();
  for (std::size_t i = 0; i < now.size(); ++i) {
    next[i].a = now[i].first, next[i].b = now[i].second;
    while (old != pairs.end() && std::pair{old->a, old->b} < now[i]) ++old;
    if (old != pairs.end() && old->a == next[i].a && old->b == next[i].b) next[i] = *old;
  }
  pairs = std::move(next);
}

double mass_of(Model const& m, int tet) {
  double sum = 0;
  for (int c = 0; c < 4; ++c) sum += m.mass[model::node_of(tet, c)];
  return sum;
}

double largest_face(Model const& m, int tet) {
  auto const x = mesh::corners(m.mesh, tet);
  double most = 0;
  for (auto const& f : mesh::face_corners)
    most = std::max(most, 0.5 * norm(cross(x[f[1]] - x[f[0]], x[f[2]] - x[f[0]])));
  return most;
}

/// p/h of a tet, as in its joints [Pa/m].
double face_stiffness(Model const& m, int tet) {
  auto const& c = m.source.concretes[m.material_of_tet[tet]];
  return model::joint_penalty(c) / geometry::regular_edge(geometry::volume(mesh::corners(m.mesh, tet)));
}

/// Fragments of one body rub as the faces of their cracks did; bodies that were never joined as [contact]
/// says.
double friction_of(Model const& m, std::vector<int> const& body, int a, int b) {
  auto const &ca = m.source.concretes[m.material_of_tet[a]], &cb = m.source.concretes[m.material_of_tet[b]];
  double const own = std::min(ca.friction, cb.friction);
  if (body[a] == body[b]) return own;
  for (auto const& p : m.source.contact_pairs)
    if ((p.materials[0] == ca.name && p.materials[1] == cb.name) ||
        (p.materials[0] == cb.name && p.materials[1] == ca.name))
      return p.friction;
  return m.source.contact.friction >= 0 ? m.source.contact.friction : own;
}

/// Two springs in series, but no more than the step can bear.
state::ContactScratch::PairConstants constants_of(Model const& m, std::vector<int> const& body,
                                                  ContactPair const& p) {
  double const k_a = face_stiffness(m, p.a), k_b = face_stiffness(m, p.b);
  double const m_a = mass_of(m, p.a), m_b = mass_of(m, p.b);
  double const area = std::min(largest_face(m, p.a), largest_face(m, p.b));
  double const limit = stability_share * m_a * m_b / ((m_a + m_b) * m.dt * m.dt * area);
  double const k_n = std::min(2 * k_a * k_b / (k_a + k_b), limit);
  return {0.5 * k_n, friction_of(m, body, p.a, p.b)}; // the potential presses with 2 k g
}

/// Work arrays of the present pairs: constants, overlay slots, and who acts on which tet.
void prepare(Model const& m, State const& s, Scratch& w) {
  auto& c = w.contact;
  auto const& pairs = s.contact.pairs;
  if (c.body.empty()) c.body = mesh::connected_bodies(m.mesh, m.adjacency);
  c.constants.resize(pairs.size());
  c.force.assign(pairs.size(), {});
  c.separator.assign(pairs.size(), 0);
  parallel::for_chunks(pairs.size(), tets_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) c.constants[i] = constants_of(m, c.body, pairs[i]);
  });
  struct Meeting {
    int tet, pair;
    bool is_a;
  };
  std::vector<Meeting> all;
  all.reserve(2 * pairs.size());
  for (int i = 0; i < static_cast<int>(pairs.size()); ++i) {
    all.push_back({pairs[i].a, i, true});
    all.push_back({pairs[i].b, i, false});
  }
  std::sort(all.begin(), all.end(),
            [](auto const& x, auto const& y) { return x.tet != y.tet ? x.tet < y.tet : x.pair < y.pair; });
  c.hosts.clear(), c.entries.clear();
  for (auto const& e : all) {
    if (c.hosts.empty() || c.hosts.back().tet != e.tet) {
      int const at = static_cast<int>(c.entries.size());
      c.hosts.push_back({e.tet, w.overlay.slot_for(e.tet), at, at});
    }
    c.entries.push_back({e.pair, e.is_a});
    c.hosts.back().end = static_cast<int>(c.entries.size());
  }
}

double mean_size(Model const& m, std::vector<int> const& tets) {
  double sum = 0;
  for (int const t : tets) sum += geometry::regular_edge(geometry::volume(mesh::corners(m.mesh, t)));
  return tets.empty() ? 0 : sum / static_cast<double>(tets.size());
}

void search(Model const& m, State& s, Scratch& w) {
  auto& c = s.contact;
  Linkage const link = find_linkage(m, s);
  c.is_due = 0;
  w.contact.surface = surface_tets(m, s);
  // The list must hold at least until the next look, better for some of them.
  c.travel = window_travel(m, s, w.contact.surface);
  c.skin = std::max(skin_share * mean_size(m, w.contact.surface), 10 * c.travel);
  take_over(c.pairs, near_pairs(m, s, link, w.contact.surface, 0.5 * c.skin));
  prepare(m, s, w);
}

} // namespace

void refresh_pairs(Model const& m, State& s, Scratch& w) {
  if (!m.source.contact.on) return;
  auto& c = s.contact;
  if (w.contact.surface
          .empty()) { // the work arrays are new, as after a restart: the list itself is in the state
    w.contact.surface = surface_tets(m, s);
    prepare(m, s, w);
  }
  if (s.step % steps_between_looks != 0) return;
  c.travel += window_travel(m, s, w.contact.surface);
  if (c.is_due || 2 * c.travel > skin_used * c.skin) search(m, s, w);
}

} // namespace fissura::contact
