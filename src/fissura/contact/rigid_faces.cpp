// All tets within a skin of a body are looked up at once; then nothing is looked up until the fastest node
// and the fastest body may have used up the skin. Speeds are read every few steps only and may rise
// meanwhile: the bound takes twice the speed read, and adds a speed that a strong wave brings.
#include "fissura/contact/rigid_faces.hpp"

#include <algorithm>
#include <cmath>

#include "fissura/contact/rigid.hpp"
#include "fissura/contact/rigid_face.hpp"
#include "fissura/contact/rigid_shape.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/parallel/parallel.hpp"

namespace fissura::contact {

using model::Model;
using state::RigidScratch;
using state::Scratch;
using state::State;

namespace {

constexpr std::size_t tets_per_chunk = 512;
constexpr double longest_wait = 64;  // steps between two looks at the speeds
constexpr double wave_strain = 1e-3; // times the wave speed: what a wave may add to a speed meanwhile
constexpr double skin_share = 0.25;  // of the mean size of the tets

struct Largest {
  double value = 0;
  Largest& operator+=(Largest const& b) {
    value = std::max(value, b.value);
    return *this;
  }
};

double mean_size(Model const& m) {
  double volume = 0;
  for (int t = 0; t < m.tets.count; ++t) volume += m.tets.volume[static_cast<std::size_t>(t)];
  return geometry::regular_edge(volume / std::max(1, m.tets.count));
}

double fastest_wave(Model const& m) {
  double c = 0;
  for (auto const& k : m.source.concretes) c = std::max(c, std::sqrt(k.E / k.density));
  return c;
}

/// Largest speed of a node plus that of a body [m/s].
double fastest_approach(Model const& m, State const& s) {
  auto const nodes = static_cast<std::size_t>(4 * m.tets.count);
  std::size_t const grain = std::max<std::size_t>(2048, nodes / 256 + 1); // few enough parts for sum_chunks
  double const node = parallel::sum_chunks<Largest>(nodes, grain, [&](std::size_t begin, std::size_t end) {
                        Largest most;
                        for (std::size_t i = begin; i < end; ++i) {
                          Vec3 const v = s.v.at(i);
                          most.value = std::max(most.value, dot(v, v));
                        }
                        return most;
                      }).value;
  double body = 0;
  for (auto const& b : s.rigid.body) body = std::max(body, norm(b.v));
  return std::sqrt(node) + body;
}

geometry::Tet current(Model const& m, State const& s, int tet) {
  geometry::Tet x;
  for (int a = 0; a < 4; ++a) {
    auto const n = static_cast<std::size_t>(model::node_of(tet, a));
    x[static_cast<std::size_t>(a)] = m.position.at(n) + s.u.at(n);
  }
  return x;
}

/// Whether any part of the tet may lie within the skin of the body.
bool is_near(Model const& m, State const& s, int tet, std::size_t body, double skin) {
  auto const x = current(m, s, tet);
  Vec3 const centre = geometry::centroid(x);
  double reach = 0;
  for (Vec3 const& corner : x) reach = std::max(reach, norm(corner - centre));
  return distance(m.rigid[body], centre - s.rigid.body[body].u).value <= reach + skin;
}

/// A broken joint lets its faces go, closed or not: crushed concrete is pushed out between its neighbours
/// edge first, and that edge has to meet the body while every face behind it is still pressed against a
/// neighbour.
bool is_free(State const& s, int joint) {
  return s.joint_status[static_cast<std::size_t>(joint)] >=
         static_cast<std::uint8_t>(state::JointStatus::broken);
}

void find_near_tets(Model const& m, State const& s, RigidScratch& r) {
  auto const tets = static_cast<std::size_t>(m.tets.count);
  r.is_near.resize(tets);
  parallel::for_chunks(tets, tets_per_chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      r.is_near[t] = 0;
      for (std::size_t b = 0; b < m.rigid.size() && !r.is_near[t]; ++b)
        r.is_near[t] = is_near(m, s, static_cast<int>(t), b, r.skin);
    }
  });
  r.tets.clear();
  for (std::size_t t = 0; t < tets; ++t)
    if (r.is_near[t]) r.tets.push_back(static_cast<int>(t));
}

/// The faces of one near tet: free ones are listed, those with a joint watched.
void list_faces(Model const& m, State const& s, Scratch& w, int tet) {
  auto& r = w.rigid;
  int const begin = static_cast<int>(r.faces.size());
  for (int face = 0; face < 4; ++face) {
    int const shared = m.adjacency.shared_of_tet[tet][face];
    int const joint = shared < 0 ? -1 : m.joint_of_shared_face[shared];
    if (shared >= 0 && joint < 0) continue; // bonded for ever
    if (joint >= 0 && !is_free(s, joint)) {
      r.watched.push_back(joint);
      continue;
    }
    Triangle const x = on_face(m.position, tet, face);
    double const area = 0.5 * norm(cross(x[1] - x[0], x[2] - x[0]));
    for (std::size_t b = 0; b < m.rigid.size(); ++b)
      if (is_near(m, s, tet, b, r.skin))
        r.faces.push_back({tet, static_cast<std::uint8_t>(face), static_cast<std::uint16_t>(b), area,
                           rigid_stiffness(m, tet, area, m.rigid[b])});
  }
  int const end = static_cast<int>(r.faces.size());
  if (end > begin) r.hosts.push_back({tet, w.overlay.slot_for(tet), begin, end});
}

/// Lists the free faces of the near tets.
void list_all(Model const& m, State& s, Scratch& w) {
  auto& r = w.rigid;
  r.faces.clear();
  r.hosts.clear();
  r.watched.clear();
  for (int const t : r.tets) list_faces(m, s, w, t);
  r.results.resize(r.faces.size());
  r.first.resize(r.faces.size());
  s.rigid.touch.reserve(face_points.size() * r.faces.size());
}

bool any_came_free(State const& s, RigidScratch const& r) {
  for (int const joint : r.watched)
    if (is_free(s, joint)) return true;
  return false;
}

/// Whether the list has to be made anew; looks at the speeds when that is due.
bool skin_is_used_up(Model const& m, State const& s, RigidScratch& r) {
  if (s.step < r.next_check) return false;
  double const each = m.dt * (2 * fastest_approach(m, s) + wave_strain * fastest_wave(m)); // [m] per step
  // A quarter of what is left, so that a look comes well before the end.
  auto const wait = [&] { return std::floor(0.25 * (r.skin - r.used) / each); };
  bool const is_used_up = r.next_check < 0 || !(wait() >= 1);
  if (is_used_up) r.used = 0;
  double const steps = std::clamp(wait(), 1.0, longest_wait);
  r.used += steps * each;
  r.next_check = s.step + static_cast<long>(steps);
  return is_used_up;
}

} // namespace

void refresh_rigid_faces(Model const& m, State& s, Scratch& w) {
  auto& r = w.rigid;
  if (r.next_check < 0) r.skin = skin_share * mean_size(m);
  if (skin_is_used_up(m, s, r)) {
    find_near_tets(m, s, r);
    list_all(m, s, w);
  } else if (any_came_free(s, r)) {
    list_all(m, s, w);
  }
}

} // namespace fissura::contact
