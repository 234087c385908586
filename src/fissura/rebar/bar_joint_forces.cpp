#include <algorithm>
#include <cmath>

#include "fissura/parallel/parallel.hpp"
#include "fissura/rebar/activation.hpp"
#include "fissura/rebar/element_energy.hpp"
#include "fissura/rebar/kernels.hpp"
#include "fissura/rebar/rebar.hpp"

namespace fissura::rebar {

namespace {

/// One bar joint at u_n, with all that its law needs.
class JointStep {
 public:
  JointStep(model::Model const& m, state::State& s, state::Scratch& w, SlipBy by, std::size_t index)
      : m_(m), whole_(s), joint_(m.bars.joints[index]), law_(m.bars.joint_law[index]), s_(s.bars),
        i_(index), nodes_{m.position, s.u}, now_(w.bars.joint[index]),
        slip_only_(m.bars.settings.between_cracks == model::BarBetweenCracks::slip_only) {
    if (by == SlipBy::path && s_.history[i_].activated) follow_path();
    slip_ = 0.5 * (now_.axial + (slip_only_ ? elongation_of_halves() : 0));
  }

  void advance() {
    auto& h = s_.history[i_];
    if (!h.activated && law_.crackable && some_face_separates()) {
      auto const& before = s_.motion[i_];
      s_.account[i_].bond_steel +=
          laws::activate(law_.activated, h, before.slip_from_start, {before.t_1, before.t_2, 0},
                         s_.joint_stress[i_], before.held);
    }
    if (h.activated) {
      slide(h);
    } else {
      follow_concrete();
    }
    remember();
  }

 private:
  double elongation_of_halves() const {
    auto const a = static_cast<std::size_t>(joint_.elem_a), b = static_cast<std::size_t>(joint_.elem_b);
    return 0.5 * (s_.elongation[a] + s_.elongation[b]);
  }

  bool some_face_separates() const {
    if (now_.may_separate == 0) return false;
    for (int f = joint_.faces_begin; f < joint_.faces_end; ++f) {
      auto const& face = m_.bars.faces[f];
      auto const& shared = m_.adjacency.shared[face.shared_face];
      auto const law =
          laws::with_strength(m_.joints.law(face.joint), state::strength_factor(whole_, face.joint));
      if (separates(face, shared, law, nodes_)) return true;
    }
    return false;
  }

  /// Whether the faces touch where the bar crosses them; not asked where the answer changes nothing.
  bool touches(laws::BarJointHistory const& h) const {
    auto const& bond = law_.activated.bond;
    if (bond.k_closed == 0 || h.ruptured || laws::is_pressed(bond, h.bond, slip_ - h.S_0)) return false;
    for (int f = joint_.faces_begin; f < joint_.faces_end; ++f) {
      auto const& face = m_.bars.faces[f];
      if (separation_at(face, m_.adjacency.shared[face.shared_face], nodes_).opening > 0) return false;
    }
    return true;
  }

  /// The bar takes its share of the traction in the undamaged faces (docs/theory/bars.md, "Before cracking").
  void follow_concrete() {
    double const sigma = law_.intact.stress(now_.axial) + law_.prestress;
    act(sigma, {});
    s_.joint_stress[i_] = sigma;
    s_.joint_strain[i_] = sigma / m_.bars.properties[joint_.bar].steel.E_s;
  }

  /// How far the two points that the force acts on have parted over the last step [m].
  Vec3 parted() const {
    Vec3 sum;
    for (int c = 0; c < 4; ++c)
      sum += now_.w_b[c] * whole_.v.at(model::node_of(joint_.tet_b, c)) -
             now_.w_a[c] * whole_.v.at(model::node_of(joint_.tet_a, c));
    return m_.dt * sum;
  }

  /// The slip goes on by what the force works on. Measured from the positions, d.r, it would also change as
  /// the hosts shear or stretch, by up to |d| times their strain: that moves neither force, and in a wide
  /// crack a vibrating tet would gain energy from it (docs/theory/bar_joint.md, "Slip along the path").
  void follow_path() {
    Vec3 const step = parted();
    auto const& before = s_.motion[i_];
    now_.axial = before.axial + dot(step, Vec3(now_.r));
    now_.t_1 = before.t_1 + 0.5 * dot(step, Vec3(now_.across_1));
    now_.t_2 = before.t_2 + 0.5 * dot(step, Vec3(now_.across_2));
  }

  /// Slip law along the bar and dowel action across it (Eqs. 20-27).
  void slide(laws::BarJointHistory& h) {
    bool const was_whole = !h.ruptured;
    double const t_1 = now_.t_1 - h.t_0.x, t_2 = now_.t_2 - h.t_0.y, t_s = std::hypot(t_1, t_2);
    laws::BarJointDissipation lost;
    auto const force = laws::bar_joint_force(law_.activated, h, slip_ - h.S_0, t_s, lost, touches(h));
    book(lost, was_whole && h.ruptured);
    Vec3 const across =
        t_s > 0 ? (t_1 / t_s) * Vec3(now_.across_1) + (t_2 / t_s) * Vec3(now_.across_2) : Vec3{};
    act(force.sigma, force.V_s * across);
    s_.joint_stress[i_] = force.sigma;
    s_.joint_strain[i_] = h.strain;
    s_.slip[i_] = slip_ - h.S_0;
    s_.normalised_slip[i_] = s_.slip[i_] * law_.activated.bond.normalise;
    s_.dowel_force[i_] = force.V_s;
  }

  void book(laws::BarJointDissipation const& lost, bool breaks_now) {
    auto& account = s_.account[i_];
    if (breaks_now) {
      account.rupture += lost.bond_steel + lost.dowel; // all that it held
    } else {
      account.bond_steel += lost.bond_steel;
      account.dowel += lost.dowel;
    }
  }

  /// Both sides are pulled at one point, halfway between P_A and P_B: no couple.
  void act(double sigma, Vec3 dowel) {
    now_.pull = sigma * m_.bars.properties[joint_.bar].area;
    now_.force = now_.pull * Vec3(now_.r) + dowel;
  }

  void remember() {
    auto& motion = s_.motion[i_];
    motion = {now_.axial, slip_, now_.t_1, now_.t_2, 0};
    if (s_.history[i_].activated) return;
    motion.held = intact_energy(law_, now_.axial);
    if (!slip_only_) return;
    for (int e : {joint_.elem_a, joint_.elem_b}) motion.held += 0.5 * elastic_energy(m_.bars, s_, e);
  }

  model::Model const& m_;
  state::State const& whole_;
  model::BarJoint const& joint_;
  model::BarJointLaw const& law_;
  state::BarState& s_;
  std::size_t i_;
  Nodes nodes_;
  state::BarScratch::Joint& now_;
  bool slip_only_;
  double slip_ = 0;
};

} // namespace

void bar_joint_forces(model::Model const& m, state::State& s, state::Scratch& w, SlipBy by) {
  auto const pass = bar_pass(m, s, w);
  auto const& kernels = bar_kernels();
  parallel::for_chunks(w.bars.element_lanes.size(), 16, [&](std::size_t, std::size_t begin, std::size_t end) {
    kernels.stretch_elements(pass, begin, end);
  });
  parallel::for_chunks(w.bars.joint_lanes.size(), 16, [&](std::size_t, std::size_t begin, std::size_t end) {
    kernels.move_joints(pass, begin, end);
    std::size_t const last = std::min(8 * end, m.bars.joints.size());
    for (std::size_t i = 8 * begin; i < last; ++i) JointStep(m, s, w, by, i).advance();
  });
}

} // namespace fissura::rebar
