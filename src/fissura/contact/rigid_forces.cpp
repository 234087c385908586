#include <algorithm>
#include <tuple>

#include "fissura/contact/rigid.hpp"
#include "fissura/contact/rigid_face.hpp"
#include "fissura/contact/rigid_faces.hpp"
#include "fissura/contact/rigid_law.hpp"
#include "fissura/contact/rigid_shape.hpp"
#include "fissura/geometry/tet.hpp"
#include "fissura/model/defaults.hpp"
#include "fissura/parallel/parallel.hpp"

namespace fissura::contact {

using model::Model;
using state::RigidScratch;
using state::RigidTouch;
using state::Scratch;
using state::State;

namespace {

constexpr std::size_t hosts_per_chunk = 64;
/// k_n A dt^2 over the tet's mass, at most. The step is stable up to 0.25 and beyond; but a face that meets a
/// body within one step gains or loses energy in proportion (0.5 % of a cube of 4 cells that lands flat, at
/// 0.25).
constexpr double stable_share = 0.05;

auto order_of(RigidTouch const& t) {
  return std::tuple(t.tet, t.face, t.body);
}
auto order_of(RigidScratch::Face const& f) {
  return std::tuple(f.tet, f.face, f.body);
}

/// Where the memory of each face begins: both lists have the same order.
void find_memories(State const& s, RigidScratch& r) {
  auto const& touch = s.rigid.touch;
  std::size_t i = 0;
  for (std::size_t f = 0; f < r.faces.size(); ++f) {
    while (i < touch.size() && order_of(touch[i]) < order_of(r.faces[f])) ++i;
    r.first[f] = static_cast<int>(i);
  }
}

/// One face against one body.
class FacePass {
 public:
  FacePass(Model const& m, State const& s, RigidScratch::Face const& face)
      : m_(m), s_(s), face_(face), body_(m.rigid[face.body]), moved_(s.rigid.body[face.body].u),
        x_(positions(m, s, face.tet, face.face)) {}

  bool may_touch() const {
    Vec3 const centre = (x_[0] + x_[1] + x_[2]) / 3;
    double reach = 0;
    for (Vec3 const& corner : x_) reach = std::max(reach, norm(corner - centre));
    return distance(body_, centre - moved_).value <= reach;
  }

  /// Books what the points of a face hold that is out of reach now.
  void let_go(int first, RigidScratch::Result& result) const {
    auto const& touch = s_.rigid.touch;
    for (auto i = static_cast<std::size_t>(first); i < touch.size() && order_of(touch[i]) == order_of(face_);
         ++i)
      result.lost += held_across(touch[i]);
  }

  /// Fills in the result and adds the forces of the corners.
  void act(int first, RigidScratch::Result& result, double* corner_force) {
    v_ = on_face(s_.v, face_.tet, face_.face);
    auto const& touch = s_.rigid.touch;
    auto next = static_cast<std::size_t>(first);
    for (std::size_t q = 0; q < face_points.size(); ++q) {
      while (next < touch.size() && order_of(touch[next]) == order_of(face_) && touch[next].point < q) ++next;
      Vec3 const x = at(x_, face_points[q]) - moved_;
      auto const d = distance(body_, x);
      bool const known =
          next < touch.size() && order_of(touch[next]) == order_of(face_) && touch[next].point == q;
      if (!(d.value < 0)) {
        if (known) result.lost += held_across(touch[next]);
        continue;
      }
      Vec3 const step = m_.dt * (at(v_, face_points[q]) - s_.rigid.body[face_.body].v);
      press(q, -d.value, d.normal, step, known ? touch[next] : fresh(q, x - step), result, corner_force);
    }
  }

 private:
  /// A point that has just come into touch; one that was inside already (its face came free there) keeps that
  /// depth as its offset.
  RigidTouch fresh(std::size_t q, Vec3 x_before) const {
    double const before = -distance(body_, x_before).value;
    return {face_.tet, face_.face, static_cast<std::uint8_t>(q), face_.body, std::max(0.0, before), {}};
  }

  /// Energy of the tangential spring [J], which is lost when its point comes free.
  double held_across(RigidTouch const& touch) const {
    double const area = face_.area * face_points[touch.point].share;
    return area * rigid_stored({face_.stiffness, body_.friction}, {0, touch.stretch}, 0);
  }

  void press(std::size_t q, double g, Vec3 normal, Vec3 step, RigidTouch touch, RigidScratch::Result& result,
             double* corner_force) const {
    RigidMemory memory{touch.offset, touch.stretch};
    auto const t = rigid_traction({face_.stiffness, body_.friction}, memory, g, normal, step);
    double const area = face_.area * face_points[q].share;
    Vec3 const force = area * t.on_concrete;
    for (int k = 0; k < 3; ++k) {
      double* const f =
          corner_force + core::per_node * mesh::face_corners[face_.face][static_cast<std::size_t>(k)];
      double const share = face_points[q].corner[static_cast<std::size_t>(k)];
      for (int i = 0; i < 3; ++i) f[i] += share * force[i];
    }
    touch.offset = memory.offset;
    touch.stretch = memory.stretch;
    result.touch[static_cast<std::size_t>(result.count++)] = touch;
    result.force += force;
    result.lost += area * t.lost;
  }

  Model const& m_;
  State const& s_;
  RigidScratch::Face const& face_;
  model::RigidBody const& body_;
  Vec3 moved_; ///< displacement of the body
  Triangle x_, v_{};
};

void act_on(Model const& m, State const& s, Scratch& w, RigidScratch::Host const& host) {
  auto& r = w.rigid;
  for (int i = host.begin; i < host.end; ++i) {
    auto const f = static_cast<std::size_t>(i);
    auto& result = r.results[f];
    result.count = 0;
    result.force = {};
    result.lost = 0;
    FacePass pass(m, s, r.faces[f]);
    if (pass.may_touch())
      pass.act(r.first[f], result, w.overlay.at(host.slot));
    else
      pass.let_go(r.first[f], result);
  }
}

/// Sums in the order of the faces that touch: which others are listed changes nothing.
void collect(State& s, RigidScratch const& r) {
  s.rigid.touch.clear();
  for (auto& b : s.rigid.body) b.force = {};
  for (std::size_t f = 0; f < r.faces.size(); ++f) {
    auto const& result = r.results[f];
    s.ledger.contact_friction += result.lost;
    if (result.count == 0) continue;
    s.rigid.touch.insert(s.rigid.touch.end(), result.touch.begin(), result.touch.begin() + result.count);
    s.rigid.body[r.faces[f].body].force += result.force;
  }
}

double face_area(Model const& m, int tet, int face) {
  Triangle const x = on_face(m.position, tet, face);
  return 0.5 * norm(cross(x[1] - x[0], x[2] - x[0]));
}

} // namespace

double rigid_stiffness(Model const& m, int tet, double area, model::RigidBody const& body) {
  auto const t = static_cast<std::size_t>(tet);
  auto const& c = m.source.concretes[static_cast<std::size_t>(m.material_of_tet[t])];
  double const penalty = model::joint_penalty(c);
  double mass = 0;
  for (int a = 0; a < 4; ++a) mass += m.mass[static_cast<std::size_t>(model::node_of(tet, a))];
  if (body.is_impactor) {
    double const share = body.mass * std::min(1.0, area / touchable_area(body));
    mass = mass * share / (mass + share);
  }
  return std::min(penalty / geometry::regular_edge(m.tets.volume[t]),
                  stable_share * mass / (m.dt * m.dt * area));
}

void rigid_forces(Model const& m, State& s, Scratch& w) {
  if (m.rigid.empty()) return;
  refresh_rigid_faces(m, s, w);
  find_memories(s, w.rigid);
  parallel::for_chunks(w.rigid.hosts.size(), hosts_per_chunk,
                       [&](std::size_t, std::size_t begin, std::size_t end) {
                         for (std::size_t h = begin; h < end; ++h) act_on(m, s, w, w.rigid.hosts[h]);
                       });
  collect(s, w.rigid);
}

double rigid_energy(Model const& m, State const& s) {
  double sum = 0;
  for (auto const& t : s.rigid.touch) {
    auto const& body = m.rigid[t.body];
    auto const& q = face_points[t.point];
    double const area = face_area(m, t.tet, t.face);
    Vec3 const x = at(positions(m, s, t.tet, t.face), q) - s.rigid.body[t.body].u;
    RigidLaw const law{rigid_stiffness(m, t.tet, area, body), body.friction};
    sum += area * q.share * rigid_stored(law, {t.offset, t.stretch}, -distance(body, x).value);
  }
  return sum;
}

} // namespace fissura::contact
