// Two tets that share one joint, moved by hand: what becomes of force and energy as the joint breaks, closes,
// slides off and is replaced by contact.
#include <gtest/gtest.h>

#include "fissura/contact/contact.hpp"
#include "support/cases.hpp"
#include "support/concrete_model.hpp"

namespace fissura {
namespace {

using support::Random;

/// Tet b is moved as a rigid body, tet a is held. The joint is soft, so that paths of some hundred steps
/// resolve its law: its strength is reached at 0.2 mm (tension).
struct Pair {
  model::Model m;
  state::State s;
  state::Scratch w;
  Vec3 shift, turn; ///< of tet b: translation and rotation vector about the centroid of the face
  Vec3 force;       ///< on tet b by joint and contact [N]
  double work = 0, largest = 0;
  std::array<Vec3, 4> on_b{};
  bool is_first = true;

  explicit Pair(model::ShearStrength shear)
      : m(make(shear)), s(step::make_state(m)), w(step::make_scratch(m, s)) {
    move({}, {});
  }

  static model::Model make(model::ShearStrength shear) {
    mesh::Mesh mesh;
    mesh.points = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.03, 0.03, -0.08}, {0.03, 0.03, 0.08}};
    mesh.tets = {{0, 2, 1, 3}, {0, 1, 2, 4}};
    mesh.tet_group = {0, 0};
    mesh.volume_groups = {"concrete"};
    mesh.input_id = {0, 1};
    auto c = support::plain_concrete();
    c.penalty = 0.1 * c.E;
    c.shear = shear, c.f_s = 6e6, c.G_f = 600;
    auto m = support::concrete_model(mesh, c);
    m.dt = 1e-5; // far from any stability limit: nothing is integrated
    return m;
  }
  double area() const { return m.joints.joints[0].area; }
  double strength() const { return m.source.concretes[0].f_t * area(); }
  state::JointStatus status() const { return static_cast<state::JointStatus>(s.joint_status[0]); }

  /// Moves tet b there in one step, and books the work by the trapezoidal rule.
  void move(Vec3 to, Vec3 rotation) {
    Vec3 const centre{0.1 / 3, 0.1 / 3, 0};
    Mat3 const R = support::rotation_minus_identity(rotation, norm(rotation));
    std::array<Vec3, 4> step;
    for (int c = 0; c < 4; ++c) {
      int const node = model::node_of(1, c);
      Vec3 const u = to + R * (support::position(m, node) - centre), old = support::at_node(s.u, node);
      step[c] = u - old;
      support::set_node(s.u, node, u);
      support::set_node(s.v, node, step[c] / m.dt);
    }
    shift = to, turn = rotation;
    auto const before = on_b;
    evaluate();
    if (!is_first)
      for (int c = 0; c < 4; ++c) {
        double const d = -0.5 * dot(before[c] + on_b[c], step[c]);
        work += d;
        largest += std::abs(d);
      }
    is_first = false;
    s.step += 4; // every move is a look at the pairs
  }
  void evaluate() {
    contact::refresh_pairs(m, s, w);
    concrete::joint_forces(m, s, w);
    w.overlay.clear();
    contact::pair_forces(m, s, w);
    on_b = {};
    auto const& face = m.adjacency.shared[0];
    auto const& joint = m.joints.joints[0];
    bool const own = status() != state::JointStatus::intact;
    for (int k = 0; k < 3; ++k) {
      double const* const f = w.joints.force.data() + (own ? w.joints.side_b(0) : 0) + 3 * k;
      on_b[joint.node_b[k] % 4] += (own ? 1 : -1) * Vec3{f[0], f[1], f[2]};
    }
    EXPECT_EQ(face.b.tet, 1);
    if (int const slot = w.overlay.slot_of_tet[1]; slot >= 0)
      for (int c = 0; c < 4; ++c) {
        double const* const f = w.overlay.at(slot) + 3 * c;
        on_b[c] += Vec3{f[0], f[1], f[2]};
      }
    force = {};
    for (auto const& f : on_b) force += f;
  }
  double stored() const { return concrete::joint_energy(m, s) + s.contact.stored; }
  double dissipated() const {
    auto const d = concrete::joint_dissipation(m, s);
    return d.mode_I + d.mode_II + d.friction + s.ledger.contact_friction;
  }

  /// Goes straight to a place in equal steps; stops where it meets too much force on its way, or when told.
  template <class Stop> void go(Vec3 to, Vec3 rotation, int steps, Stop stop) {
    Vec3 const from = shift, turned = turn;
    for (int i = 1; i <= steps; ++i) {
      double const t = static_cast<double>(i) / steps;
      move(from + t * (to - from), turned + t * (rotation - turned));
      if (stop()) return;
    }
  }
};

/// Moves on until the joint's status becomes `next`, then looks at the same place again: nothing may jump.
void expect_no_jump(Pair& p, Vec3 to, int steps, state::JointStatus next) {
  Vec3 const from = p.shift;
  for (int i = 1; i <= steps; ++i) {
    p.move(from + (static_cast<double>(i) / steps) * (to - from), {});
    if (p.status() != next) continue;
    Vec3 const force = p.force;
    for (int look = 0; look < 3; ++look) {
      p.move(p.shift, {});
      EXPECT_LE(norm(p.force - force), 1e-6 * p.strength()) << "look " << look;
    }
    return;
  }
  FAIL() << "the joint never got there";
}

// Requirement: at the hand-over from cohesion to a crack-face pair the force of a joint that is pulled apart
// does not jump by more than 1e-6 of f_t A.
TEST(HandOver, is_smooth_in_tension) {
  Pair p(model::ShearStrength::constant);
  expect_no_jump(p, {0, 0, 2e-3}, 3000, state::JointStatus::broken);
  EXPECT_LE(norm(p.force), 1e-6 * p.strength());
}

// Requirement: nor in shear.
TEST(HandOver, is_smooth_in_shear) {
  Pair p(model::ShearStrength::constant);
  expect_no_jump(p, {2e-3, 1e-3, 0}, 3000, state::JointStatus::broken);
}

// Requirement: nor in shear under compression, with either shear strength; friction is what is left.
TEST(HandOver, is_smooth_in_shear_under_compression) {
  for (auto const shear : {model::ShearStrength::constant, model::ShearStrength::mohr_coulomb}) {
    Pair p(shear);
    p.go({0, 0, -1e-4}, {}, 100, [] { return false; });
    expect_no_jump(p, {3e-3, 1e-3, -1e-4}, 3000, state::JointStatus::broken);
    Vec3 const on =
        p.shift + Vec3{1e-3, 0, 0}; // with a constant strength friction is mobilised only from here
    p.go(on, {}, 50, [] { return false; });
    EXPECT_LT(p.force.x, 0);
    EXPECT_NEAR(std::hypot(p.force.x, p.force.y) / p.force.z, 0.6, 0.05);
  }
}

// Requirement: a pair that slides on under pressure gives its load to contact without a jump, neither where
// contact begins to see it nor where it lets go.
TEST(HandOver, is_smooth_when_contact_takes_over_under_pressure) {
  Pair p(model::ShearStrength::mohr_coulomb);
  p.go({0, 0, -1e-4}, {}, 100, [] { return false; });
  expect_no_jump(p, {0.06, 0, -1e-4}, 4000, state::JointStatus::parting);
  EXPECT_GT(p.force.z, 0.1 * p.strength()) << "the pair still presses";
  expect_no_jump(p, {0.12, 0, -1e-4}, 4000, state::JointStatus::released);
}

// Requirement: a crack that opens wide is released, and when it closes again contact carries compression with
// the joint's own stiffness within 15 % (the overlap of two tets narrows with depth).
TEST(HandOver, contact_closes_a_wide_crack_with_the_stiffness_of_the_joint) {
  Pair p(model::ShearStrength::constant);
  p.go({0, 0, 0.06}, {}, 2000, [] { return false; });
  EXPECT_EQ(p.status(), state::JointStatus::released);
  p.go({0, 0, 0}, {}, 2000, [] { return false; });
  EXPECT_EQ(norm(p.force), 0);
  double const depth = 1e-4, stiffness = p.m.joints.law(0).k;
  p.go({0, 0, -depth}, {}, 100, [] { return false; });
  EXPECT_NEAR(p.force.z, stiffness * p.area() * depth, 0.15 * stiffness * p.area() * depth);
}

// Requirement: a tet that tips over an edge of its crack face and lands upside down is not pushed by a face
// it no longer lies against: the force stays within twice the tensile strength all the way to 220 degrees.
TEST(HandOver, lets_a_tipping_tet_go) {
  Pair p(model::ShearStrength::constant);
  Vec3 const centre{0.1 / 3, 0.1 / 3, 0}; // turns about the y axis through the origin, where the joint closes
  for (int i = 1; i <= 4400; ++i) {
    double const angle = i * 220.0 / 4400 * 3.14159265358979 / 180;
    Vec3 const axis{0, -1, 0};
    Vec3 const to = support::rotation_minus_identity(axis, angle) * centre;
    p.move(to, angle * axis);
    ASSERT_LE(norm(p.force), 2 * p.strength()) << angle;
  }
  EXPECT_EQ(p.status(), state::JointStatus::released);
}

// Requirement: a tet that twists in the plane of its crack face, about the middle of an edge where the joint
// holds, is let go before the mid-triangle of both faces shrinks to nothing: the force stays within four
// times the tensile strength all the way to 220 degrees. (At 180 a joint that still held one point threw two
// tets out of a beam under a drop weight.)
TEST(HandOver, lets_a_twisting_tet_go) {
  Pair p(model::ShearStrength::constant);
  Vec3 const arm = Vec3{0.05, 0, 0} - Vec3{0.1 / 3, 0.1 / 3, 0};
  for (int i = 1; i <= 4400; ++i) {
    double const angle = i * 220.0 / 4400 * 3.14159265358979 / 180;
    Vec3 const axis{0, 0, 1};
    p.move(-1.0 * (support::rotation_minus_identity(axis, angle) * arm), angle * axis);
    ASSERT_LE(norm(p.force), 4 * p.strength()) << angle;
  }
  EXPECT_EQ(p.status(), state::JointStatus::released);
}

/// One random move: pull apart, press, slide, or turn a little. Stops where the force gets too large.
void random_move(Pair& p, Random& random, double size) {
  double const pressing = random.uniform(-3e-4, 1e-4), far = size * random.uniform(-1, 1);
  Vec3 to = p.shift, turn = p.turn;
  switch (random.next() % 4) {
  case 0:
    to.z = pressing;
    break;
  case 1:
    to = {far, size * random.uniform(-1, 1), p.shift.z};
    break;
  case 2:
    to.z = random.uniform(0, 4e-3);
    break;
  default:
    turn = random.vector(-2e-3, 2e-3);
  }
  double const distance = norm(to - p.shift) + 0.1 * norm(turn - p.turn);
  int const steps = 20 + static_cast<int>(distance / 2e-5);
  double const limit = 20 * p.strength();
  p.go(to, turn, std::min(steps, 2000), [&] { return norm(p.force) > limit; });
  if (norm(p.force) > limit) p.go(p.shift + 3e-4 * unit(p.force), p.turn, 200, [] { return false; });
}

// Requirement: over 1,000 random cycles of breaking, closing and sliding (40 joints, 25 cycles each) no
// energy is created: what was put in equals what is stored and dissipated within 1e-3 of the work done.
TEST(HandOver, random_cycles_create_no_energy) {
  double worst = 0;
  int broken = 0, released = 0;
  for (int joint = 0; joint < 40; ++joint) {
    Random random(static_cast<std::uint64_t>(100 + joint));
    Pair p(joint % 2 ? model::ShearStrength::mohr_coulomb : model::ShearStrength::constant);
    for (int cycle = 0; cycle < 25; ++cycle) {
      for (int move = 0; move < 3; ++move) random_move(p, random, cycle < 10 ? 5e-3 : 0.08);
      double const missing = p.work - p.stored() - p.dissipated();
      worst = std::min(worst, missing / p.largest);
      EXPECT_NEAR(missing, 0, 1e-3 * p.largest) << "joint " << joint << " cycle " << cycle;
    }
    broken += p.status() >= state::JointStatus::broken;
    released += p.status() == state::JointStatus::released;
  }
  EXPECT_GT(broken, 30);
  EXPECT_GT(released, 5);
  EXPECT_GT(worst, -1e-3);
}

} // namespace
} // namespace fissura
